// SPDX-License-Identifier: Apache-2.0
#pragma once
// Area of a B-spline surface, and the volume between it and a point.
#include "sublimit/patches/spline_surface.h"

namespace sublimit {

struct SurfaceIntegrals {
  double area = 0;
  double volume = 0;  ///< signed: positive where du x dv looks away from the apex
};

/// Integrates by Gauss's rule on each face, whose volumes are exact if the surface is not rational.
/// @param apex  of the cone whose volume it is; of closed surfaces it does not matter
SurfaceIntegrals surface_integrals(const SplineSurface& surface, const Points& columns, Coordinates coordinates,
                                   const Eigen::RowVector3d& apex);

}  // namespace sublimit
