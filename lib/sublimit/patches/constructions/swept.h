// SPDX-License-Identifier: Apache-2.0
#pragma once
// Swept surfaces: a curve translated along another one, or moved by given frames along a path, and surfaces
// through sections.
// Source: Piegl, Tiller 1997, "The NURBS Book", sections 10.3 and 10.4.
#include <span>
#include <vector>

#include "sublimit/patches/constructions/spline_net.h"

namespace sublimit {

/// Returns the surface c(u) + d(v) - origin. For rational curves weights are products.
SplineNet translational(CurveNet c, CurveNet d, const Eigen::RowVector3d& origin);

/// Returns the surface o(v) + A(v) c(u), where o is a spline of points and A a spline of matrices over the same
/// knots. The matrices need not be rotations. The surface is linear in them and in the section.
/// @param matrices  3 x 3, one for each control point of the path
/// @throws InvalidParameter  another number of origins or matrices than control points of the path
SplineNet sweep(const CurveNet& section, const Knots<double>& path, const Points& origins,
                std::span<const Eigen::Matrix3d> matrices);

/// Returns the surface through sections at given v: an interpolating B-spline in v (interpolation.h) with
/// averaged knots.
/// @param sections    curves over the same knots, at least degree_v + 1
/// @param parameters  v of each section, strictly ascending
/// @throws InvalidParameter  sections with different knots, too few sections, equal parameters
SplineNet loft(std::vector<CurveNet> sections, int degree_v, std::span<const double> parameters);

}  // namespace sublimit
