// SPDX-License-Identifier: Apache-2.0
#include "sublimit/stencils/gallery/surface_distance.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace sublimit::gallery {
namespace {

using Eigen::Vector3d;

double squared_distance_to_segment(const Vector3d& p, const Vector3d& a, const Vector3d& b) {
  const Vector3d along = b - a;
  const double length = along.squaredNorm();
  const double t = length > 0 ? std::clamp((p - a).dot(along) / length, 0., 1.) : 0;
  return (p - a - t * along).squaredNorm();
}

double squared_distance_to_triangle(const Vector3d& p, const std::array<Vector3d, 3>& t) {
  const Vector3d normal = (t[1] - t[0]).cross(t[2] - t[0]);
  const double area = normal.squaredNorm();
  bool above = area > 0;  // p projects into the triangle
  for (int i = 0; above && i < 3; ++i) above = normal.cross(t[(i + 1) % 3] - t[i]).dot(p - t[i]) >= 0;
  if (above) return std::pow(normal.dot(p - t[0]), 2) / area;
  return std::min({squared_distance_to_segment(p, t[0], t[1]), squared_distance_to_segment(p, t[1], t[2]),
                   squared_distance_to_segment(p, t[2], t[0])});
}

}  // namespace

SurfaceDistance::SurfaceDistance(const Topology& topology, const Points& points) {
  for (Index f = 0; f < topology.num_faces(); ++f) {
    const auto corners = topology.vertices(Face{f});
    for (size_t i = 1; i + 1 < corners.size(); ++i)
      triangles_.push_back({points.row(corners[0]), points.row(corners[i]), points.row(corners[i + 1])});
  }
  assert(!triangles_.empty());
  build(0, static_cast<int>(triangles_.size()));
}

int SurfaceDistance::build(int first, int count) {
  constexpr int leaf = 4;
  const int at = static_cast<int>(nodes_.size());
  Node node;
  node.first = first;
  node.count = count;
  for (int i = first; i < first + count; ++i)
    for (const Vector3d& corner : triangles_[i]) node.box.extend(corner);
  nodes_.push_back(node);
  if (count <= leaf) return at;
  Eigen::Index axis = 0;
  node.box.sizes().maxCoeff(&axis);
  const auto middle = [&](const Triangle& t) { return t[0][axis] + t[1][axis] + t[2][axis]; };
  const auto begin = triangles_.begin() + first;
  std::nth_element(begin, begin + count / 2, begin + count,
                   [&](const Triangle& a, const Triangle& b) { return middle(a) < middle(b); });
  const int left = build(first, count / 2), right = build(first + count / 2, count - count / 2);
  nodes_[at].count = 0;
  nodes_[at].left = left;
  nodes_[at].right = right;
  return at;
}

double SurfaceDistance::operator()(const Vector3d& p, double enough) const {
  double best = std::numeric_limits<double>::infinity();
  const double stop = enough * enough;
  std::vector<std::pair<double, int>> open{{nodes_[0].box.squaredExteriorDistance(p), 0}};
  while (!open.empty() && best > stop) {
    const auto [bound, at] = open.back();
    open.pop_back();
    if (bound >= best) continue;
    const Node& node = nodes_[at];
    for (int i = node.first; i < node.first + node.count; ++i)
      best = std::min(best, squared_distance_to_triangle(p, triangles_[i]));
    if (node.count > 0) continue;
    std::pair<double, int> near{nodes_[node.left].box.squaredExteriorDistance(p), node.left};
    std::pair<double, int> far{nodes_[node.right].box.squaredExteriorDistance(p), node.right};
    if (far < near) std::swap(near, far);
    open.push_back(far);
    open.push_back(near);
  }
  return std::sqrt(best);
}

}  // namespace sublimit::gallery
