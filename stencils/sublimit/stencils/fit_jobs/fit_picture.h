// SPDX-License-Identifier: Apache-2.0
#pragma once
// Fits as pictures: what was given, and the limit that was fitted, with the targets as dots, normals as needles and
// principal directions as crosses (red: k1, amber: k2).
#include <string>

#include "sublimit/stencils/fit_jobs/fit_curvatures.h"

namespace sublimit {

/// Three panels: the mesh as it was, its own limit, the limit of the fit.
/// @param given  level 0 of the mesh
std::string fit_picture(const Scheme<double>& scheme, const Level& given, const Points& given_points,
                        const ReportedFit& fit);

/// Two panels: the triangles with all their data, and what the scheme made of them.
std::string fit_picture(const CurvatureFit& fit);

}  // namespace sublimit
