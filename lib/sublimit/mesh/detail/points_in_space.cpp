// SPDX-License-Identifier: Apache-2.0
#include "sublimit/mesh/detail/points_in_space.h"

#include "sublimit/core/detail/finite_points.h"

namespace sublimit {

Points points_in_space(const Mesh& mesh) {
  const Points& points = mesh.positions;
  if (points.rows() == 0) return Points(0, 3);
  check_in_space(points);
  check_finite_control(points);
  return points;
}

}  // namespace sublimit
