// SPDX-License-Identifier: Apache-2.0
#include "sublimit/limit/detail/limit_points.h"

#include "sublimit/limit/detail/degenerate_normal.h"
#include "sublimit/limit/detail/limit_rows.h"
#include "sublimit/neighborhood/control_place.h"
#include "sublimit/neighborhood/vertex_sides.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <optional>
#include <string>

#include "sublimit/base/detail/memory.h"
#include "sublimit/base/detail/parallel_for.h"
#include "sublimit/base/error.h"
#include "sublimit/core/detail/sparse_product.h"

namespace sublimit {
namespace {

using Eigen::Vector3d;

/// How the faces of a side turn around the vertex, twice the area that they sweep: tells the two sides of a plane
/// apart.
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

/// Rows have the vertices of all faces around a vertex: the square of a large face's corners.
void check_limit_memory(const Topology& t, bool is_dual) {
  double entries = double(t.num_vertices()) + 2.0 * t.num_edges();
  Index largest = 0;
  for (Index f = 0; f < t.num_faces(); ++f) {
    const double size = t.size(Face{f});
    entries += size * (size - 3);
    largest = std::max(largest, t.size(Face{f}));
  }
  constexpr double bytes = 48;  // of three rows, with their indices, and of what they are copied from
  check_memory("limits of " + std::to_string(t.num_vertices()) + " vertices in faces of up to " +
                   std::to_string(largest) + " corners",
               bytes * (is_dual ? 2 : 1) * entries, "cut large faces, or refine first (--levels 1)");
}

}  // namespace

LimitMatrices limit_matrices(const Level& level, LimitCache& cache) {
  const Index num_vertices = level.topology().num_vertices();
  check_limit_memory(level.topology(), cache.scheme().is_dual());
  VertexSides sides = vertex_sides(level);
  LimitMatrices result;
  result.side_vertex = std::move(sides.vertex);
  result.corner_side = std::move(sides.corner_side);
  const auto num_sides = static_cast<Index>(sides.centres.size());
  std::vector<Index> first_side(static_cast<size_t>(num_vertices), -1);
  for (Index s = num_sides; s-- > 0;) first_side[result.side_vertex[s]] = s;

  // Block by block, so that rows of a large mesh are not there twice.
  using Row = LimitRows::Row;
  const Index block = std::max<Index>(1 << 14, num_sides / 16);
  StackedRows position, tangent1, tangent2, second_order;
  result.second_order_begin.push_back(0);
  for (Index begin = 0, v = 0; begin < num_sides || v < num_vertices; begin += block) {
    const Index end = std::min(begin + block, num_sides);
    const std::vector<LimitRows> rows =
        limit_rows(level, cache, std::span(sides.centres).subspan(size_t(begin), size_t(end - begin)));
    for (Index s = begin; s < end; ++s)
      result.status.push_back(sides.hole[s] ? LimitStatus::hole : rows[s - begin].status);

    const Index first = v;
    while (v < num_vertices && first_side[v] < end) ++v;
    std::vector<SparseRows::Term> isolated;
    isolated.reserve(size_t(v - first));
    std::vector<Row> list;
    for (Index u = first; u < v; ++u)
      list.push_back(first_side[u] < 0 ? Row(&isolated.emplace_back(u, 1.0), 1)
                                       : rows[first_side[u] - begin].position());
    position.add(matrix_of(list, num_vertices));
    const auto of_sides = [&](const auto& part) {
      list.clear();
      for (const LimitRows& row : rows) list.push_back(part(row));
      return matrix_of(list, num_vertices);
    };
    tangent1.add(of_sides([](const LimitRows& row) { return row.tangent1(); }));
    tangent2.add(of_sides([](const LimitRows& row) { return row.tangent2(); }));
    list.clear();
    for (const LimitRows& row : rows) {
      for (size_t k = 0; k < row.num_second_order(); ++k) list.push_back(row.second_order(k));
      result.second_order_begin.push_back(result.second_order_begin.back() +
                                          static_cast<Index>(row.num_second_order()));
    }
    second_order.add(matrix_of(list, num_vertices));
  }
  std::move(position).matrix(num_vertices).swap(result.position);
  std::move(tangent1).matrix(num_vertices).swap(result.tangent1);
  std::move(tangent2).matrix(num_vertices).swap(result.tangent2);
  std::move(second_order).matrix(num_vertices).swap(result.second_order);
  return result;
}

LimitMatrices limit_matrices(const std::vector<Level>& levels, LimitCache& cache) {
  try {
    return limit_matrices(levels.back(), cache);
  } catch (const NoLimit& error) {
    if (levels.size() == 1 || error.vertex < 0) throw;
    throw NoLimit(control_place(levels, Vertex{error.vertex}), error.reason);
  }
}

LimitPoints limit_points(const LimitMatrices& limit, const Topology& topology, const Points& points) {
  if (points.cols() != 3)
    throw InvalidParameter("limit points need 3 coordinates, not " + std::to_string(points.cols()));
  LimitPoints result;
  result.position = apply(limit.position, points);
  result.status = limit.status;
  // Squares of huge or tiny tangents would leave the range of numbers; powers of two change no digit.
  const double largest = points.size() > 0 ? points.cwiseAbs().maxCoeff() : 0;
  const double unit = largest > 1e100 || (largest > 0 && largest < 1e-100) ? std::ldexp(1.0, -std::ilogb(largest)) : 1;
  const Points scaled = unit == 1 ? Points() : Points(points * unit);
  const Points& x = unit == 1 ? points : scaled;
  const Points t1 = apply(limit.tangent1, x), t2 = apply(limit.tangent2, x);
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
    for (Index k = limit.second_order_begin[s]; k < limit.second_order_begin[s + 1]; ++k) {
      modes.push_back(Vector3d::Zero());
      for (SparseMatrix::InnerIterator it(limit.second_order, k); it; ++it)
        modes.back() += it.value() * x.row(it.col()).transpose();
    }
    const Vector3d normal = degenerate_normal(a, b, modes, scale, turn_of(limit, topology, static_cast<Index>(s), x));
    if (normal.isZero()) {
      result.status[s] = LimitStatus::undefined_normal;
      return;
    }
    result.normal.row(s) = normal;
  });
  return result;
}

}  // namespace sublimit
