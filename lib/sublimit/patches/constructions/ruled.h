// SPDX-License-Identifier: Apache-2.0
#pragma once
// Ruled surfaces: between two curves, cylinders, cones, and the hyperbolic paraboloid through four points. v is
// the parameter along the lines, from 0 to 1.
// Source: Piegl, Tiller 1997, "The NURBS Book", sections 8.3 and 8.4.
#include <Eigen/Core>

#include "sublimit/patches/constructions/spline_net.h"

namespace sublimit {

/// Returns the surface (1 - v) c0(u) + v c1(u), of degree 1 in v. For rational curves the homogeneous columns
/// are blended: the lines are the same, but the speed along them is not constant.
/// @throws InvalidParameter  curves with different domains
SplineNet ruled(CurveNet c0, CurveNet c1);

/// Returns the bilinear patch of four points.
/// @param corners  4 x 3: at (0,0), (1,0), (0,1), (1,1)
SplineNet bilinear_patch(const Points& corners);

/// Returns the generalised cylinder c(u) + v direction.
SplineNet extrusion(const CurveNet& curve, const Eigen::RowVector3d& direction);

/// Returns the cone (1 - v) c(u) + v apex, whose side v = 1 is collapsed.
SplineNet cone(const CurveNet& curve, const Eigen::RowVector3d& apex);

}  // namespace sublimit
