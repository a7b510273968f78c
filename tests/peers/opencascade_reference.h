// SPDX-License-Identifier: Apache-2.0
#pragma once
// OpenCASCADE's B-splines, run live. LGPL 2.1 with an exception: for tests and benchmarks only.
#include <array>
#include <functional>
#include <span>
#include <vector>

#include "sublimit/patches/knots.h"
#include "sublimit/patches/patch.h"

namespace sublimit::testing {

/// Position and derivatives with respect to the knots' parameters: first and second of a curve; du, dv, duu,
/// duv, dvv of a surface.
using CurveDerivatives = std::array<Eigen::Vector3d, 3>;
using SurfaceDerivatives = std::array<Eigen::Vector3d, 6>;

/// Evaluates a Geom_BSplineCurve; for closed knots the points are repeated.
/// @param columns  homogeneous, positive weights
std::vector<CurveDerivatives> opencascade_curve(const Knots<double>& knots, const Points& columns,
                                                std::span<const double> parameters);
/// Evaluates a Geom_BSplineSurface.
std::vector<SurfaceDerivatives> opencascade_surface(const Knots<double>& u, const Knots<double>& v,
                                                    const Points& columns,
                                                    std::span<const Patch::Parameters> parameters);

/// For benchmarks: makes a surface of OpenCASCADE, and returns a function that evaluates places one by one, by
/// D0 or D1, into 3 or 9 numbers for each place. Columns are plain if there are three, otherwise homogeneous.
std::function<void(std::span<const Patch::Parameters>, bool derivatives, std::span<double>)> opencascade_run(
    const Knots<double>& u, const Knots<double>& v, const Points& columns);

}  // namespace sublimit::testing
