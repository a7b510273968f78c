// SPDX-License-Identifier: Apache-2.0
#pragma once
// Aspect ratios of triangles. The aspect ratio of a triangle is its longest side over its shortest height:
// 2/sqrt(3) if all sides are equal, 2 with a right angle between two equal ones, infinite without an area.
#include "sublimit/tessellation/tessellate.h"

namespace sublimit {

/// Statistics of aspect ratios.
struct TriangleShapes {
  double largest_aspect = 0, median_aspect = 0;  ///< of triangles with an area; 0 if there are none
  std::int64_t without_area = 0;                 ///< number of triangles without area, as at collapsed sides
};

/// Returns the aspect ratio of a triangle.
double aspect_ratio(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c);
/// Returns the statistics of a tessellation.
TriangleShapes triangle_shapes(const Tessellation& made);

}  // namespace sublimit
