// SPDX-License-Identifier: Apache-2.0
#pragma once
// What becomes of a scheme's claims, and its row in the summary: both read from what was found, as a reader of the
// report would.
#include <optional>
#include <string>

#include "sublimit/report/analysis/neighborhood.h"

namespace sublimit::report {

/// What is found of a property of a scheme, nothing where it is not decided, and why.
struct Finding {
  std::optional<bool> holds;
  std::string because;
};
/// Whether old vertices inside stay, by the rows of those in the list: the type of a scheme. Those of a dual scheme
/// have no children.
/// @param neighborhoods  of SCHEME
Finding interpolation_inside(const Json& neighborhoods);
/// The same of all vertices, those of borders and sharp edges too: what a claim says.
Finding interpolation(const Json& neighborhoods);
/// Whether new points are convex combinations of old ones, by the rows of all neighbourhoods in the list.
Finding convexity(const Json& neighborhoods);

/// The least k of which C^k is disproved, if there is one: exponents alone do not tell C^(k-1,1) from C^k.
std::optional<int> disproved_continuity(const Json& verdicts);

/// Gives interior neighbourhoods of regular valence what is proved of regular meshes.
/// @param scheme  SCHEME with `regular` and `neighborhoods`
void use_regular(Json& scheme);

/// CLAIMS of a scheme: those on convex hulls and interpolation only if they are made.
/// @param scheme   SCHEME with `mesh`, `regular` (or null) and `neighborhoods`
Json claims_json(const Claims& claims, const Json& scheme);

/// ROW of the summary; claims have no part in it.
/// @param scheme  SCHEME
Json summary_row(const Json& scheme);

}  // namespace sublimit::report
