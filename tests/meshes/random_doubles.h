// SPDX-License-Identifier: Apache-2.0
#pragma once
// Doubles with all kinds of bit patterns, which writers and readers must preserve.
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

namespace sublimit::testing {

/// Returns doubles of random bits, including subnormals and -0; with `not_finite` also infinities and NaN of
/// both signs.
inline std::vector<double> random_doubles(std::uint64_t seed, std::size_t count, bool not_finite = false) {
  constexpr double infinity = std::numeric_limits<double>::infinity(), nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<double> special{
      0.0, -0.0, std::numeric_limits<double>::denorm_min(), -std::numeric_limits<double>::max(), infinity, -infinity,
      nan, -nan};
  std::mt19937_64 random(seed);
  std::vector<double> numbers(count);
  for (std::size_t i = 0; i < count; ++i) {
    do {
      numbers[i] = i % 7 == 0 ? special[random() % special.size()] : std::bit_cast<double>(random());
      if (i % 5 == 1) numbers[i] = std::bit_cast<double>(random() >> 12);                  // subnormal
      if (i % 3 == 1) numbers[i] = std::round(std::ldexp(numbers[i], -1000) * 1e6) / 1e6;  // of few digits
    } while (!not_finite && !std::isfinite(numbers[i]));
  }
  return numbers;
}

}  // namespace sublimit::testing
