// SPDX-License-Identifier: Apache-2.0
#pragma once
// What a report says of a scheme, computed once more from masks: those of the scheme's own file where the registry has
// it, those that the report itself writes down where it does not.
#include <string>
#include <vector>

#include "sublimit/report/analysis/regular_json.h"
#include "sublimit/report/analysis/registered_rows.h"

namespace sublimit::report {

/// What is wrong with `regular` of a SCHEME: its verdicts, degrees and continuity against those of its mask, and its
/// mask against that of the scheme's file.
/// @param exact     the registered scheme, or null
/// @param analysed  whether the mask of a surface is analysed, which takes a second or two; else it is only compared
/// @throws nlohmann::json::exception, FormatError  no REGULAR
std::vector<std::string> regular_differs(const Json& scheme, const ExactScheme* exact, bool analysed = true);

/// `rows` of a neighbourhood by the masks of the registered scheme.
/// @throws FormatError  no such kind of neighbourhood
Json rows_again(const Json& neighborhood, const ExactScheme& exact);

/// Returns which verdicts of a neighbourhood contradict the masks of the registered scheme and their spectrum, or are
/// missing: affine invariance, convergence, the tangent plane, and C^1 where the spectrum disproves it or is a
/// borderline case. Disproofs of C^1 by the characteristic map, which have no witness, are done once more.
/// @throws FormatError  no such kind of neighbourhood
std::vector<std::string> spectrum_differs(const Json& neighborhood, const ExactScheme& exact);

/// What is wrong with the words of a SCHEME that follow from its neighbourhoods and its regular part: whether it
/// interpolates, and what becomes of its claims.
/// @param scheme  with rows that were seen again
std::vector<std::string> conclusions_differ(const Json& scheme);

/// What is wrong with the joints of CURVE.
std::vector<std::string> curve_differs(const Json& curve);

}  // namespace sublimit::report
