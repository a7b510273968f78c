// SPDX-License-Identifier: Apache-2.0
#pragma once
// Surfaces that a curve sweeps out: by translation along another one, by given frames along a path, through sections.
// Source: Piegl, Tiller 1997, "The NURBS Book", sections 10.3 and 10.4.
#include <span>
#include <vector>

#include "sublimit/patches/constructions/spline_net.h"

namespace sublimit {

/// c(u) + d(v) - origin. Of rational curves the weights are products.
SplineNet translational(CurveNet c, CurveNet d, const Eigen::RowVector3d& origin);

/// o(v) + A(v) c(u), for a spline o of points and a spline A of matrices over the same knots. The matrices need not be
/// rotations; the surface is linear in them, and in the section.
/// @param matrices  3 x 3, one for each control point of the path
/// @throws InvalidParameter  not as many origins or matrices as control points
SplineNet sweep(const CurveNet& section, const Knots<double>& path, const Points& origins,
                std::span<const Eigen::Matrix3d> matrices);

/// The surface that has sections over the same knots at given v: an interpolating B-spline in v (interpolation.h),
/// knots by averaging.
/// @param parameters  rising, one for each section
/// @throws InvalidParameter  sections of other knots, fewer than degree_v + 1 of them, equal parameters
SplineNet loft(std::vector<CurveNet> sections, int degree_v, std::span<const double> parameters);

}  // namespace sublimit
