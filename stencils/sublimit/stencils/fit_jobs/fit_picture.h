// SPDX-License-Identifier: Apache-2.0
#pragma once
// Pictures of fits: the given mesh and the fitted limit, with targets as dots, normals as needles and principal
// directions as crosses (red: k1, amber: k2).
#include <string>

#include "sublimit/stencils/fit_jobs/fit_curvatures.h"

namespace sublimit {

/// Returns a picture with three panels: the given mesh, its own limit, the limit of the fit.
/// @param given  level 0 of the mesh
std::string fit_picture(const Scheme<double>& scheme, const Level& given, const Points& given_points,
                        const ReportedFit& fit);

/// Returns a picture with two panels: the triangles with their data, and the refined ones.
std::string fit_picture(const CurvatureFit& fit);

}  // namespace sublimit
