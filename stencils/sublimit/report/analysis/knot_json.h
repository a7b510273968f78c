// SPDX-License-Identifier: Apache-2.0
#pragma once
// The effect of unequal knot intervals at extraordinary vertices.
#include "sublimit/scheme/scheme.h"
#include "sublimit/stencils/files/numbers.h"

namespace sublimit::report {

/// KNOTS of a scheme; null of those that know no intervals.
/// @param all_valences  VERDICT of equal intervals for all valences, or null
Json knot_json(const Scheme<double>& scheme, const Json& all_valences);

}  // namespace sublimit::report
