// SPDX-License-Identifier: Apache-2.0
#pragma once
// Verification of reports on schemes by computing results again from masks: those of a registered scheme's file, else
// those in the report.
#include <string>
#include <vector>

#include "sublimit/report/analysis/registered_rows.h"
#include "sublimit/report/analysis/regular_json.h"

namespace sublimit::report {

/// Returns the errors in `regular` of a SCHEME: its verdicts, degrees and continuity are compared with those of its
/// mask, and its mask with that of the scheme's file.
/// @param exact     the registered scheme, or null
/// @param analysed  true: analyse the mask of a surface, which takes a second or two; false: only compare it
/// @throws nlohmann::json::exception, FormatError  no REGULAR
std::vector<std::string> regular_differs(const Json& scheme, const ExactScheme* exact, bool analysed = true);

/// Returns `rows` of a neighbourhood, computed from the masks of the registered scheme.
/// @throws FormatError  no such kind of neighbourhood
Json rows_again(const Json& neighborhood, const ExactScheme& exact);

/// Returns which verdicts of a neighbourhood contradict the masks of the registered scheme and their spectrum, or are
/// missing: affine invariance, convergence, the tangent plane, and C^1 where the spectrum disproves it or is a
/// borderline case. Disproofs of C^1 by the characteristic map, which have no witness, are done once more.
/// @throws FormatError  no such kind of neighbourhood
std::vector<std::string> spectrum_differs(const Json& neighborhood, const ExactScheme& exact);

/// Returns the errors in the words of a SCHEME that follow from its neighbourhoods and regular part: whether it
/// interpolates, and the verdicts on its claims.
/// @param scheme  SCHEME with verified rows
std::vector<std::string> conclusions_differ(const Json& scheme);

/// Returns the errors in the joints of CURVE.
std::vector<std::string> curve_differs(const Json& curve);

}  // namespace sublimit::report
