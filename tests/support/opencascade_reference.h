// SPDX-License-Identifier: Apache-2.0
#pragma once
// OpenCASCADE's B-splines, live. LGPL 2.1 with an exception: for tests and benchmarks only.
#include <array>
#include <functional>
#include <span>
#include <vector>

#include "sublimit/patches/knots.h"
#include "sublimit/patches/patch.h"

namespace sublimit::testing {

/// Position, then first, second derivative of a curve; du, dv, duu, duv, dvv of a surface; by the knots' parameters.
using CurveDerivatives = std::array<Eigen::Vector3d, 3>;
using SurfaceDerivatives = std::array<Eigen::Vector3d, 6>;

/// Geom_BSplineCurve, of closed knots with its points repeated.
/// @param columns  homogeneous, positive weights
std::vector<CurveDerivatives> opencascade_curve(const Knots<double>& knots, const Points& columns,
                                                std::span<const double> parameters);
/// Geom_BSplineSurface.
std::vector<SurfaceDerivatives> opencascade_surface(const Knots<double>& u, const Knots<double>& v,
                                                    const Points& columns,
                                                    std::span<const Patch::Parameters> parameters);

/// For benchmarks: a surface of OpenCASCADE, made once; evaluates places one by one, D0 or D1, into 3 or 9 numbers a
/// place. Plain columns if they are three.
std::function<void(std::span<const Patch::Parameters>, bool derivatives, std::span<double>)> opencascade_run(
    const Knots<double>& u, const Knots<double>& v, const Points& columns);

}  // namespace sublimit::testing
