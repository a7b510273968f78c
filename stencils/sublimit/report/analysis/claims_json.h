// SPDX-License-Identifier: Apache-2.0
#pragma once
// Verdicts on a scheme's claims, and its row in the summary. Both are derived from the results in the report.
#include <optional>
#include <string>

#include "sublimit/report/analysis/neighborhood.h"

namespace sublimit::report {

/// Result on a property of a scheme: true, false, or absent if undecided; and the reason.
struct Finding {
  std::optional<bool> holds;
  std::string because;
};
/// Returns whether interior vertices keep their positions, by the rows of the neighbourhoods: whether the scheme is
/// interpolatory. Vertices of a dual scheme have no children.
/// @param neighborhoods  neighbourhoods of SCHEME
Finding interpolation_inside(const Json& neighborhoods);
/// Returns whether all vertices keep their positions, those of boundaries and sharp edges too, as a claim says.
Finding interpolation(const Json& neighborhoods);
/// Returns whether new points are convex combinations of old ones, by the rows of all neighbourhoods in the list.
Finding convexity(const Json& neighborhoods);

/// Returns the least k for which a verdict disproves C^k; absent if there is none. Hoelder exponents alone do
/// not distinguish C^(k-1,1) from C^k.
std::optional<int> disproved_continuity(const Json& verdicts);

/// Replaces undecided verdicts on interior neighbourhoods of regular valence by the proofs for regular meshes.
/// @param scheme  SCHEME with `regular` and `neighborhoods`
void use_regular(Json& scheme);

/// Returns CLAIMS of a scheme. Claims on convex hulls and interpolation are included only if the scheme makes
/// them.
/// @param scheme  SCHEME with `mesh`, `regular` (or null) and `neighborhoods`
Json claims_json(const Claims& claims, const Json& scheme);

/// Returns ROW of the summary, which does not depend on the claims.
/// @param scheme  SCHEME
Json summary_row(const Json& scheme);

}  // namespace sublimit::report
