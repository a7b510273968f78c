// SPDX-License-Identifier: Apache-2.0
#pragma once
// Area of a B-spline surface, and the volume between it and a point.
#include "sublimit/patches/spline_surface.h"

namespace sublimit {

/// Results of `surface_integrals`.
struct SurfaceIntegrals {
  double area = 0;
  double volume = 0;  ///< signed: positive where du x dv points away from the apex
};

/// Returns area, and volume of the cone from a point over the surface, by a Gauss rule on each face. The volume
/// is exact up to rounding if the surface is not rational.
/// @param apex  apex of the cone; irrelevant for closed surfaces
SurfaceIntegrals surface_integrals(const SplineSurface& surface, const Points& columns, Coordinates coordinates,
                                   const Eigen::RowVector3d& apex);

}  // namespace sublimit
