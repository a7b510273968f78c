// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>

namespace sublimit {

/// Returns n over k, for n <= 60: products before the division are exact up to there.
constexpr std::int64_t binomial(int n, int k) {
  std::int64_t value = 1;
  for (int i = 1; i <= k; ++i) value = value * (n - k + i) / i;
  return value;
}

}  // namespace sublimit
