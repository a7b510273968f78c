// SPDX-License-Identifier: Apache-2.0
#pragma once
// What triangles near a surface are asked for: their distance from it, and whether they close.
#include <algorithm>
#include <array>
#include <functional>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "sublimit/tessellation/tessellate.h"

namespace sublimit::testing {

/// Returns how far triangles are from the surface at the same parameters, on a grid in each.
/// @param faces_are_triangles  of the surface
/// @param points_at            points of the surface at places
inline double largest_distance(const Tessellation& t, bool faces_are_triangles,
                               const std::function<Points(const std::vector<Place>&)>& points_at) {
  constexpr int steps = 4;
  std::vector<Place> at;
  std::vector<Eigen::RowVector3d> flat;
  for (const Tessellation::Triangle& triangle : t.triangles)
    for (int i = 0; i <= steps; ++i)
      for (int j = 0; i + j <= steps; ++j) {
        const std::array<double, 3> w{1 - double(i + j) / steps, double(i) / steps, double(j) / steps};
        Place s{triangle.face, 0, 0};
        Eigen::RowVector3d x = Eigen::RowVector3d::Zero();
        for (size_t k = 0; k < 3; ++k) {
          s.u += w[k] * triangle.uv[k][0];
          s.v += w[k] * triangle.uv[k][1];
          x += w[k] * t.points.row(triangle.vertices[k]);
        }
        s.u = std::clamp(s.u, 0.0, 1.0), s.v = std::clamp(s.v, 0.0, faces_are_triangles ? 1 - s.u : 1.0);
        at.push_back(s);
        flat.push_back(x);
      }
  const Points on = points_at(at);
  double largest = 0;
  for (size_t i = 0; i < flat.size(); ++i) largest = std::max(largest, (on.row(Index(i)) - flat[i]).norm());
  return largest;
}

/// How often each directed edge occurs, and V - E + F.
struct TriangleEdges {
  std::map<std::pair<Index, Index>, int> directed;
  Index euler = 0;
  explicit TriangleEdges(const Tessellation& t) {
    std::set<Index> used;
    std::set<std::pair<Index, Index>> undirected;
    for (const Tessellation::Triangle& triangle : t.triangles)
      for (size_t k = 0; k < 3; ++k) {
        const Index a = triangle.vertices[k], b = triangle.vertices[(k + 1) % 3];
        ++directed[{a, b}];
        undirected.insert(std::minmax(a, b));
        used.insert(a);
      }
    euler = static_cast<Index>(used.size()) - static_cast<Index>(undirected.size()) +
            static_cast<Index>(t.triangles.size());
  }
  /// Edges that no triangle has the other way round.
  int open() const {
    int count = 0;
    for (const auto& [edge, times] : directed) count += !directed.contains({edge.second, edge.first});
    return count;
  }
  bool is_manifold() const {
    return std::ranges::all_of(directed, [](const auto& edge) { return edge.second == 1; });
  }
};

}  // namespace sublimit::testing
