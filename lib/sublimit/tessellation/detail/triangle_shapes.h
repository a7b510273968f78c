// SPDX-License-Identifier: Apache-2.0
#pragma once
// How slender triangles are. The aspect ratio of a triangle is its longest side over its shortest height: 2/sqrt(3) if
// all sides are equal, 2 with a right angle between two equal ones, infinite without an area.
#include "sublimit/tessellation/tessellate.h"

namespace sublimit {

struct TriangleShapes {
  double largest_aspect = 0, median_aspect = 0;  ///< of those that have an area; 0: there are none
  std::int64_t without_area = 0;                 ///< as where a side of a face is one point
};

double aspect_ratio(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c);
TriangleShapes triangle_shapes(const Tessellation& made);

}  // namespace sublimit
