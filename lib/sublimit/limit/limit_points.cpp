// SPDX-License-Identifier: Apache-2.0
#include "sublimit/limit/limit_points.h"

#include "sublimit/limit/degenerate_normal.h"
#include "sublimit/limit/limit_rows.h"
#include "sublimit/neighborhood/control_place.h"
#include "sublimit/neighborhood/vertex_sides.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <optional>

#include "sublimit/base/error.h"
#include "sublimit/base/parallel_for.h"
#include "sublimit/core/sparse_product.h"

namespace sublimit {
namespace {

using Eigen::Vector3d;

/// How the faces of a side turn around the vertex, twice the area that they sweep: tells the two sides of a plane apart.
Vector3d turn_of(const LimitMatrices& limit, const Topology& t, Index side, const Points& points) {
  const Vertex v{limit.side_vertex[side]};
  const Vector3d centre = points.row(index(v));
  Vector3d turn = Vector3d::Zero();
  for (const HalfEdge start : t.fans(v)) {
    HalfEdge h = start;
    do {
      const Vector3d a = points.row(index(t.head(h))), b = points.row(index(t.tail(t.prev(h))));
      if (limit.corner_side[index(h)] == side) turn += (a - centre).cross(b - centre);
      h = t.ccw(h);
    } while (exists(h) && h != start);
  }
  return turn;
}

}  // namespace

LimitMatrices limit_matrices(const Level& level, LimitTypes& cache) {
  const Index num_vertices = level.topology().num_vertices();
  VertexSides sides = vertex_sides(level);
  LimitMatrices result;
  result.side_vertex = std::move(sides.vertex);
  result.corner_side = std::move(sides.corner_side);
  const std::vector<LimitRows> rows = limit_rows(level, cache, sides.centres);
  for (size_t s = 0; s < rows.size(); ++s)
    result.status.push_back(sides.hole[s] ? LimitStatus::hole : rows[s].status);

  using Row = LimitRows::Row;
  const Row none;
  std::vector<Row> isolated;
  isolated.reserve(size_t(num_vertices));
  std::vector<const Row*> list;
  for (Index v = 0, side = 0; v < num_vertices; ++v) {
    if (side == std::ssize(rows) || result.side_vertex[size_t(side)] != v) {
      list.push_back(&isolated.emplace_back(Row{{v, 1.0}}));
      continue;
    }
    list.push_back(&rows[size_t(side)].position);
    while (side < std::ssize(rows) && result.side_vertex[size_t(side)] == v) ++side;
  }
  result.position = matrix_of(list, num_vertices);
  const auto of_sides = [&](const auto& part) {
    list.clear();
    for (const LimitRows& row : rows) list.push_back(part(row));
    return matrix_of(list, num_vertices);
  };
  result.tangent1 = of_sides([](const LimitRows& row) { return &row.tangent1; });
  result.tangent2 = of_sides([](const LimitRows& row) { return &row.tangent2; });
  size_t orders = 0;
  for (const LimitRows& row : rows) orders = std::max(orders, row.second_order.size());
  for (size_t k = 0; k < orders; ++k)
    result.second_order.push_back(of_sides(
        [&](const LimitRows& row) { return k < row.second_order.size() ? &row.second_order[k] : &none; }));
  return result;
}

LimitMatrices limit_matrices(const std::vector<Level>& levels, LimitTypes& cache) {
  try {
    return limit_matrices(levels.back(), cache);
  } catch (const NoLimit& error) {
    if (levels.size() == 1 || error.vertex < 0) throw;
    throw NoLimit(control_place(levels, Vertex{error.vertex}), error.reason);
  }
}

LimitPoints limit_points(const LimitMatrices& limit, const Topology& topology, const Points& points) {
  if (points.cols() != 3) throw InvalidParameter("limit points need 3 coordinates, not " + std::to_string(points.cols()));
  LimitPoints result;
  result.position = apply(limit.position, points);
  result.status = limit.status;
  // Squares of huge or tiny tangents would leave the range of numbers; powers of two change no digit.
  const double largest = points.size() > 0 ? points.cwiseAbs().maxCoeff() : 0;
  const double unit = largest > 1e100 || (largest > 0 && largest < 1e-100) ? std::ldexp(1.0, -std::ilogb(largest)) : 1;
  const Points scaled = unit == 1 ? Points() : Points(points * unit);
  const Points& x = unit == 1 ? points : scaled;
  const Points t1 = apply(limit.tangent1, x), t2 = apply(limit.tangent2, x);
  std::vector<Points> higher;
  for (const SparseMatrix& M : limit.second_order) higher.push_back(apply(M, x));
  result.normal = Points::Zero(t1.rows(), 3);
  parallel_for(t1.rows(), [&](std::int64_t s) {
    if (result.status[s] == LimitStatus::undefined_normal || result.status[s] == LimitStatus::hole) return;
    const Vector3d a = t1.row(s), b = t2.row(s), cross = a.cross(b);
    // How large the tangents would be if the points of the masks did not cancel: what "degenerate" is measured by.
    double scale = 0;
    for (const SparseMatrix* M : {&limit.tangent1, &limit.tangent2})
      for (Index k = M->outerIndexPtr()[s]; k < M->outerIndexPtr()[s + 1]; ++k)
        scale += std::abs(M->valuePtr()[k]) *
                 (x.row(M->innerIndexPtr()[k]) - unit * result.position.row(limit.side_vertex[s])).norm();
    if (cross.norm() > 1e-12 * scale * scale) {
      result.normal.row(s) = cross.normalized();
      return;
    }
    std::vector<Vector3d> modes;
    for (const Points& values : higher) modes.push_back(values.row(s));
    const Vector3d normal =
        degenerate_normal(a, b, modes, scale, turn_of(limit, topology, static_cast<Index>(s), x));
    if (normal.isZero()) {
      result.status[s] = LimitStatus::undefined_normal;
      return;
    }
    result.normal.row(s) = normal;
  });
  return result;
}

}  // namespace sublimit
