// SPDX-License-Identifier: Apache-2.0
#pragma once
// Verdicts as readers check them: the word, the reason, the theorem, and what each hypothesis rests on.
#include <string>

#include "sublimit/report/page/json.h"

namespace sublimit::page {

/// All verdicts of a list, one after the other.
std::string verdicts(const Json& list);

/// What a scheme's file claims and what was found, as a table; empty without claims.
std::string claims(const Json& list);

/// How many verdicts of each kind a report has, all its schemes and neighbourhoods together.
std::string verdict_counts(const Json& report);

}  // namespace sublimit::page
