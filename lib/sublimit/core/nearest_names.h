// SPDX-License-Identifier: Apache-2.0
#pragma once
// What a misspelt name may have meant.
#include <cstddef>
#include <string>
#include <vector>

namespace sublimit {

/// Letters to insert, delete or replace to make `other` of `name`; 0 if `other` begins with it.
std::size_t name_distance(const std::string& name, const std::string& other);

/// The names with the fewest letters to insert, delete or replace, nearest first. One that begins with the misspelt
/// name is nearer than any other.
std::vector<std::string> nearest_names(const std::string& name, std::vector<std::string> names, int count = 3);

}  // namespace sublimit
