// SPDX-License-Identifier: Apache-2.0
#include "sublimit/mesh/detail/points_in_space.h"

#include <string>

#include "sublimit/base/error.h"
#include "sublimit/core/detail/finite_points.h"

namespace sublimit {

Points points_in_space(const Mesh& mesh) {
  const Points& points = mesh.positions;
  if (points.rows() == 0) return Points(0, 3);
  if (points.cols() != 3)
    throw InvalidMesh("control points have " + std::to_string(points.cols()) + " coordinates; 3 are right");
  check_finite_control(points);
  return points;
}

}  // namespace sublimit
