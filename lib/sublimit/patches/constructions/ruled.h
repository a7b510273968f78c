// SPDX-License-Identifier: Apache-2.0
#pragma once
// Surfaces of straight lines: ruled ones between two curves, cylinders, cones, the hyperbolic paraboloid through four
// points. v goes along the lines, from 0 to 1.
// Source: Piegl, Tiller 1997, "The NURBS Book", sections 8.3 and 8.4.
#include <Eigen/Core>

#include "sublimit/patches/constructions/spline_net.h"

namespace sublimit {

/// (1 - v) c0(u) + v c1(u), of degree 1 in v. Of rational curves the columns are blended: the lines are the same, the
/// speed along them is not constant.
/// @throws InvalidParameter  curves of other domains
SplineNet ruled(CurveNet c0, CurveNet c1);

/// The bilinear patch of four points.
/// @param corners  4 x 3: at (0,0), (1,0), (0,1), (1,1)
SplineNet bilinear_patch(const Points& corners);

/// c(u) + v direction: a generalised cylinder.
SplineNet extrusion(const CurveNet& curve, const Eigen::RowVector3d& direction);

/// (1 - v) c(u) + v apex; v = 1 is a pole of the parametrisation.
SplineNet cone(const CurveNet& curve, const Eigen::RowVector3d& apex);

}  // namespace sublimit
