// SPDX-License-Identifier: Apache-2.0
#pragma once
// What becomes of a scheme's claims, and its row in the summary: both read from what was found, as a reader of the
// report would.
#include "sublimit/report/analysis/neighborhood.h"

namespace sublimit::report {

/// What the weights of all neighbourhoods show.
struct WeightFindings {
  bool has_negative_weights = false, keeps_vertices = true;
};

/// The least k of which C^k is disproved, if there is one: exponents alone do not tell C^(k-1,1) from C^k.
std::optional<int> disproved_continuity(const Json& verdicts);

/// Gives interior neighbourhoods of regular valence what is proved of regular meshes.
/// @param scheme  SCHEME with `regular` and `neighborhoods`
void use_regular(Json& scheme);

/// CLAIMS of a scheme.
/// @param scheme   SCHEME with `regular` (or null) and `neighborhoods`
Json claims_json(const Claims& claims, const Json& scheme, const WeightFindings& weights);

/// ROW of the summary.
/// @param scheme  SCHEME with its claims
Json summary_row(const Json& scheme);

}  // namespace sublimit::report
