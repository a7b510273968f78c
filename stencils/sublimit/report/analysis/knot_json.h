// SPDX-License-Identifier: Apache-2.0
#pragma once
// The effect of unequal knot intervals at extraordinary vertices.
#include "sublimit/scheme/scheme.h"
#include "sublimit/stencils/json/numbers.h"

namespace sublimit::report {

/// Returns KNOTS of a scheme; null if the scheme does not use knot intervals.
/// @param all_valences  VERDICT on all valences with equal intervals, or null
Json knot_json(const Scheme<double>& scheme, const Json& all_valences);

}  // namespace sublimit::report
