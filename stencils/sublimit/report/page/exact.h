// SPDX-License-Identifier: Apache-2.0
#pragma once
// Fractions as reports write them, "9/64": reading them, and bringing masks to a common denominator, as
// textbooks do.
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "sublimit/report/page/json.h"

namespace sublimit::page {

struct Fraction {
  std::int64_t top = 0, bottom = 1;
};

/// Reads a fraction or whole number; absent for other exact numbers (cosines, roots) and for too many digits.
std::optional<Fraction> fraction(const std::string& text);

/// Weights over a common denominator.
struct Common {
  std::int64_t denominator = 1;
  std::vector<std::int64_t> tops;
};
/// Returns the weights of entries over a common denominator; absent if one of them is not a fraction or the
/// denominator exceeds a million.
/// @param entries  array of {"exact": ...}
std::optional<Common> common_denominator(const Json& entries);

}  // namespace sublimit::page
