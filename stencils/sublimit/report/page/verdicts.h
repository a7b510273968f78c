// SPDX-License-Identifier: Apache-2.0
#pragma once
// Verdicts with everything that readers need to check them: the word, the reason, the theorem, and the basis of
// each hypothesis.
#include <string>

#include "sublimit/report/page/json.h"

namespace sublimit::page {

/// Returns all verdicts of a list as HTML.
std::string verdicts(const Json& list);

/// Returns a table of a scheme's claims and the results on them; empty without claims.
std::string claims(const Json& list);

/// Returns the number of verdicts of each kind in a report, over all schemes and neighbourhoods.
std::string verdict_counts(const Json& report);

}  // namespace sublimit::page
