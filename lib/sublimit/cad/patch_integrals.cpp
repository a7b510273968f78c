// SPDX-License-Identifier: Apache-2.0
#include "sublimit/cad/patch_integrals.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <vector>

#include "sublimit/core/detail/finite_points.h"
#include "sublimit/integrals/detail/quadrature.h"

namespace sublimit {

SurfaceIntegrals surface_integrals(const SplineSurface& surface, const Points& columns, Coordinates coordinates,
                                   const Eigen::RowVector3d& apex) {
  check_finite_control(columns);
  const int degree = std::max(surface.u().degree(), surface.v().degree());
  // Of x . (du x dv) the degree is 3 p - 1 in each direction; quotients and roots take more.
  const std::vector<QuadraturePoint> rule = square_rule(std::max(12, 3 * degree / 2 + 1));
  SurfaceIntegrals result;
  std::vector<Place> places(rule.size());
  for (Index face = 0; face < surface.num_faces(); ++face) {
    for (size_t k = 0; k < rule.size(); ++k) places[k] = {face, rule[k].u, rule[k].v};
    const LimitSamples at = surface.evaluate(columns, places, 1, coordinates);
    for (size_t k = 0; k < rule.size(); ++k) {
      const auto row = Eigen::Index(k);
      const Eigen::Vector3d x = at.position.row(row) - apex, du = at.du.row(row), dv = at.dv.row(row);
      const Eigen::Vector3d normal = du.cross(dv);
      result.area += rule[k].weight * normal.norm();
      result.volume += rule[k].weight * x.dot(normal) / 3;
    }
  }
  return result;
}

}  // namespace sublimit
