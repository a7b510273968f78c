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

/// Rows of several matrices, in order, from one block of vertices.
struct Rows {
  std::vector<Index> columns, lengths;
  std::vector<double> values;
  void append(const LimitMasks::Mask& mask, const std::vector<Index>& vertices) {
    static thread_local std::vector<std::pair<Index, double>> row;
    row.clear();
    for (size_t i = 0; i < vertices.size(); ++i)
      if (mask[Eigen::Index(i)] != 0) row.push_back({vertices[i], mask[Eigen::Index(i)]});
    std::stable_sort(row.begin(), row.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    Index length = 0;
    for (const auto& [c, w] : row) {  // coinciding points add up
      if (length > 0 && columns.back() == c) {
        values.back() += w;
        continue;
      }
      columns.push_back(c);
      values.push_back(w);
      ++length;
    }
    lengths.push_back(length);
  }
  void append(const LimitRows::Row& row) {
    for (const auto& [c, w] : row) {
      columns.push_back(c);
      values.push_back(w);
    }
    lengths.push_back(static_cast<Index>(row.size()));
  }
};

SparseMatrix joined(const std::vector<Rows>& blocks, Index columns) {
  Index rows = 0;
  std::int64_t nonzeros = 0;
  for (const Rows& block : blocks) {
    rows += static_cast<Index>(block.lengths.size());
    nonzeros += static_cast<std::int64_t>(block.columns.size());
  }
  SparseMatrix M(rows, columns);
  if (nonzeros > std::numeric_limits<Index>::max()) throw ResourceError("limit rows: more nonzeros than 32-bit indices count");
  resize_nonzeros(M, nonzeros);
  Index row = 0, at = 0;
  for (const Rows& block : blocks) {
    std::copy(block.columns.begin(), block.columns.end(), M.innerIndexPtr() + at);
    std::copy(block.values.begin(), block.values.end(), M.valuePtr() + at);
    for (const Index length : block.lengths) {
      M.outerIndexPtr()[row++] = at;
      at += length;
    }
  }
  M.outerIndexPtr()[rows] = at;
  return M;
}

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

/// The general way: a centre for each side of each vertex.
LimitMatrices lone_limit_matrices(const Level& level, LimitMaskCache& cache) {
  const Topology& t = level.topology();
  VertexSides sides = vertex_sides(level);
  LimitMatrices result;
  result.side_vertex = std::move(sides.vertex);
  result.corner_side = std::move(sides.corner_side);
  for (const bool hole : sides.hole) result.status.push_back(hole ? LimitStatus::hole : LimitStatus::regular);
  const std::vector<LimitRows> rows = limit_rows(level, cache, sides.centres);

  Rows position, tangent1, tangent2;
  size_t orders = 0;
  for (const LimitRows& row : rows) orders = std::max(orders, row.second_order.size());
  std::vector<Rows> second(orders);
  size_t side = 0;
  for (Index v = 0; v < t.num_vertices(); ++v) {
    if (side == rows.size() || result.side_vertex[side] != v) {
      position.append(LimitRows::Row{{v, 1.0}});  // an isolated vertex
      continue;
    }
    position.append(rows[side].position);
    for (; side < rows.size() && result.side_vertex[side] == v; ++side) {
      const LimitRows& row = rows[side];
      tangent1.append(row.tangent1);
      tangent2.append(row.tangent2);
      for (size_t k = 0; k < orders; ++k) second[k].append(k < row.second_order.size() ? row.second_order[k] : LimitRows::Row{});
      LimitStatus& status = result.status[side];
      if (status == LimitStatus::hole) continue;
      status = generic_status(row, cache.scheme());
    }
  }
  result.position = joined({std::move(position)}, t.num_vertices());
  result.tangent1 = joined({std::move(tangent1)}, t.num_vertices());
  result.tangent2 = joined({std::move(tangent2)}, t.num_vertices());
  for (Rows& part : second) result.second_order.push_back(joined({std::move(part)}, t.num_vertices()));
  return result;
}

}  // namespace

LimitMatrices limit_matrices(const Level& level, LimitMaskCache& cache) {
  if (!has_one_ring_limits(cache.scheme())) return lone_limit_matrices(level, cache);
  const Topology& t = level.topology();
  const Scheme<double>& scheme = cache.scheme();
  struct Block {
    Rows position, tangent1, tangent2;
    std::vector<Rows> second;
    std::vector<Index> side_vertex;
    std::vector<LimitStatus> status;
    std::vector<std::pair<HalfEdge, Index>> corners;  // corner, side within the block
    std::optional<NoLimit> failure;
  };
  std::vector<Block> blocks(num_blocks(t.num_vertices()));
  parallel_for_blocks(t.num_vertices(), [&](std::int64_t b, std::int64_t begin, std::int64_t end) {
    Block& block = blocks[b];
    for (std::int64_t i = begin; i < end; ++i) {
      const NeighborhoodAt at = neighborhood(t, level.sharpness, Vertex{static_cast<Index>(i)});
      const LimitMasks* found = nullptr;
      try {
        found = &cache.masks(at.type);
      } catch (const AnalysisError& error) {
        block.failure.emplace(static_cast<Index>(i), level.number, error.what());
        return;
      }
      const LimitMasks& masks = *found;
      block.position.append(masks.position, at.vertices);
      for (const LimitMasks::Side& side : masks.sides) {
        const Index number = static_cast<Index>(block.side_vertex.size());
        block.tangent1.append(side.tangent1, at.vertices);
        block.tangent2.append(side.tangent2, at.vertices);
        while (block.second.size() < side.second_order.size()) {
          block.second.emplace_back();
          block.second.back().lengths.assign(number, 0);
        }
        for (size_t k = 0; k < block.second.size(); ++k) {
          if (k < side.second_order.size()) {
            block.second[k].append(side.second_order[k], at.vertices);
          } else {
            block.second[k].lengths.push_back(0);
          }
        }
        bool hole = true;
        const auto& corners = at.corners[side.fan];
        for (Index c = 0; c < side.num_corners; ++c) {
          const HalfEdge h = corners[(side.first_corner + c) % corners.size()];
          hole &= level.holes[index(t.face(h))];
          block.corners.push_back({h, number});
        }
        block.side_vertex.push_back(static_cast<Index>(i));
        block.status.push_back(hole ? LimitStatus::hole
                                    : generic_status(masks, side, scheme));
      }
    }
  });

  for (const Block& block : blocks)
    if (block.failure) throw *block.failure;
  LimitMatrices result;
  result.corner_side.assign(t.num_half_edges(), -1);
  std::vector<Rows> position, tangent1, tangent2;
  size_t orders = 0;
  for (const Block& block : blocks) orders = std::max(orders, block.second.size());
  std::vector<std::vector<Rows>> second(orders);
  for (Block& block : blocks) {
    const Index first = static_cast<Index>(result.side_vertex.size());
    for (const auto& [h, side] : block.corners) result.corner_side[index(h)] = first + side;
    result.side_vertex.insert(result.side_vertex.end(), block.side_vertex.begin(), block.side_vertex.end());
    result.status.insert(result.status.end(), block.status.begin(), block.status.end());
    for (size_t k = 0; k < orders; ++k) {
      if (k >= block.second.size()) block.second.emplace_back().lengths.assign(block.side_vertex.size(), 0);
      second[k].push_back(std::move(block.second[k]));
    }
    position.push_back(std::move(block.position));
    tangent1.push_back(std::move(block.tangent1));
    tangent2.push_back(std::move(block.tangent2));
  }
  result.position = joined(position, t.num_vertices());
  result.tangent1 = joined(tangent1, t.num_vertices());
  result.tangent2 = joined(tangent2, t.num_vertices());
  for (const auto& rows : second) result.second_order.push_back(joined(rows, t.num_vertices()));
  return result;
}

LimitMatrices limit_matrices(const std::vector<Level>& levels, LimitMaskCache& cache) {
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
