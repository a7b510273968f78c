// SPDX-License-Identifier: Apache-2.0
#pragma once
// Fractions as reports write them, "9/64": read, and brought to one denominator, as textbooks print masks.
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "sublimit/report/page/json.h"

namespace sublimit::page {

struct Fraction {
  std::int64_t top = 0, bottom = 1;
};

/// A fraction or whole number; none for other words (cosines, roots) and what is too long.
std::optional<Fraction> fraction(const std::string& text);

/// Weights over a common denominator.
struct Common {
  std::int64_t denominator = 1;
  std::vector<std::int64_t> tops;
};
/// @param entries  array of {"exact": ...}; none if one of them is no fraction or the denominator passes a million
std::optional<Common> common_denominator(const Json& entries);

}  // namespace sublimit::page
