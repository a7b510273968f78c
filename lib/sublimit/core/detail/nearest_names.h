// SPDX-License-Identifier: Apache-2.0
#pragma once
// Suggestions for misspelt names.
#include <string>
#include <vector>

namespace sublimit {

/// Returns the names that may be meant, nearest first: those with the least edit distance, or one more, but at
/// most half of the length of the misspelt name. A name that starts with the misspelt one is nearer than any
/// other.
std::vector<std::string> nearest_names(const std::string& name, std::vector<std::string> names, int count = 3);

/// Returns a text with the names that may be meant, "the nearest are a, b", or "there are " and all names if
/// none is near.
std::string nearest_in_words(const std::string& name, const std::vector<std::string>& names);

}  // namespace sublimit
