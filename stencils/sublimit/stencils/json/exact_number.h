// SPDX-License-Identifier: Apache-2.0
#pragma once
// Numbers of a file: a double, and the text as written, for exact computations.
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace sublimit {

struct ExactNumber {
  double value = 0;                             ///< the nearest double
  std::string text{};                           ///< text in the file: digits of a JSON number, or "p/q"
  std::int64_t numerator = 0, denominator = 0;  ///< p and q of "p/q", not reduced, q > 0; q = 0: not a fraction
};

using ExactPoints = std::vector<std::vector<ExactNumber>>;

/// Reads "p/q" or "p", whole numbers of 64 bits, q > 0; absent for other texts.
std::optional<ExactNumber> parse_fraction(std::string_view text);

/// Returns the double nearest to p/q, ties to even.
double nearest_double(std::int64_t p, std::int64_t q);

}  // namespace sublimit
