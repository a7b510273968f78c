// SPDX-License-Identifier: Apache-2.0
#pragma once
// What a misspelt name may have meant.
#include <string>
#include <vector>

namespace sublimit {

/// Returns the names that may be meant, nearest first: those with the fewest letters to insert, delete or replace, or
/// one more, but not more than half of the misspelt name has. One that begins with it is nearer than any other.
std::vector<std::string> nearest_names(const std::string& name, std::vector<std::string> names, int count = 3);

/// Returns the names that may be meant in words, "the nearest are a, b"; if none is near, "there are " and all names.
std::string nearest_in_words(const std::string& name, const std::vector<std::string>& names);

}  // namespace sublimit
