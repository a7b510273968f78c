// SPDX-License-Identifier: Apache-2.0
#pragma once
// What a misspelt name may have meant.
#include <string>
#include <vector>

namespace sublimit {

/// The names with the fewest letters to insert, delete or replace, nearest first. One that begins with the misspelt
/// name is nearer than any other.
std::vector<std::string> nearest_names(const std::string& name, std::vector<std::string> names, int count = 3);

}  // namespace sublimit
