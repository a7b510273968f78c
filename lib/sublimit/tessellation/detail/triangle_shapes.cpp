// SPDX-License-Identifier: Apache-2.0
#include "sublimit/tessellation/detail/triangle_shapes.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>

namespace sublimit {

double aspect_ratio(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
  const double longest = std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()});
  const double twice_area = (b - a).cross(c - a).norm();
  return twice_area > 0 ? longest / twice_area : HUGE_VAL;  // the shortest height stands on the longest side
}

TriangleShapes triangle_shapes(const Tessellation& made) {
  TriangleShapes shapes;
  std::vector<double> aspects;
  aspects.reserve(made.triangles.size());
  for (const Tessellation::Triangle& t : made.triangles) {
    const auto at = [&](size_t k) { return Eigen::Vector3d(made.points.row(t.vertices[k])); };
    const double aspect = aspect_ratio(at(0), at(1), at(2));
    if (std::isfinite(aspect))
      aspects.push_back(aspect);
    else
      ++shapes.without_area;
  }
  if (aspects.empty()) return shapes;
  shapes.largest_aspect = *std::ranges::max_element(aspects);
  const auto middle = aspects.begin() + std::ptrdiff_t(aspects.size() / 2);
  std::ranges::nth_element(aspects, middle);
  shapes.median_aspect = *middle;
  return shapes;
}

}  // namespace sublimit
