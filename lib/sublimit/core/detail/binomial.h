// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <type_traits>
#include <vector>

namespace sublimit {

/// Returns n over k, for n <= 60: products before the division are exact up to there.
constexpr std::int64_t binomial(int n, int k) {
  std::int64_t value = 1;
  for (int i = 1; i <= k; ++i) value = value * (n - k + i) / i;
  return value;
}

/// Returns n over 0, .., n over n in a number type. Those that an integer holds are made of it: 64 bits for
/// floating-point numbers, 32 for others. Larger ones are computed in the type.
template <class T>
std::vector<T> binomials(int n) {
  constexpr bool is_floating = std::is_floating_point_v<T>;
  constexpr int largest = is_floating ? 60 : 33;
  using Integer = std::conditional_t<is_floating, std::int64_t, int>;
  std::vector<T> row{T(1)};
  for (int k = 1; k <= n; ++k)
    row.push_back(n <= largest ? T(static_cast<Integer>(binomial(n, k))) : T(row.back() * T(n - k + 1) / T(k)));
  return row;
}

}  // namespace sublimit
