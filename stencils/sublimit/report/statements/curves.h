// SPDX-License-Identifier: Apache-2.0
#pragma once
// Experiments on curve schemes: symbols with exact weights, and the incentre scheme.
#include "sublimit/core/scheme_options.h"
#include "sublimit/geometric/geometric_schemes.h"
#include "sublimit/report/statements/finding.h"

namespace sublimit::report {

/// "The four-point scheme is C^1 for these tensions."
Finding four_point_is_c1(const std::vector<Ratio>& tensions);

/// "Midpoints inserted, then n averagings: a B-spline of degree n + `more`", for n = 1 ... 5.
Finding averagings_give_degree(int more);

/// "The limit of the scheme is G^1": angles between legs and tangents go to 0 with every step, and it is said whether
/// legs are refined to circular arcs from the first step on.
Finding is_g1(const GeometricCurveScheme& scheme);

/// "New points of an interpolatory tensor scheme lie between rows `stride` i and `stride` (i + 1) of the points that
/// one direction made." Rows of the fine net: the rule must reproduce their own numbers.
Finding face_point_uses_rows(int stride);

}  // namespace sublimit::report
