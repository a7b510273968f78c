// SPDX-License-Identifier: Apache-2.0
#pragma once
// The positions of each number in a list.
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace sublimit {

/// Positions of numbers in a list: those of number i are places[offsets[i]] .. places[offsets[i + 1] - 1], ascending.
/// @tparam Count  holds the length of the list
template <class Count>
struct Occurrences {
  std::vector<Count> offsets, places;
  /// @param count    numbers are 0 .. count - 1
  Occurrences(std::int64_t count, std::span<const std::int32_t> numbers)
      : offsets(size_t(count) + 1), places(numbers.size()) {
    for (const std::int32_t n : numbers) ++offsets[size_t(n) + 1];
    for (size_t i = 1; i < offsets.size(); ++i) offsets[i] += offsets[i - 1];
    std::vector<Count> next(offsets.begin(), offsets.end() - 1);
    for (size_t at = 0; at < numbers.size(); ++at) places[size_t(next[size_t(numbers[at])]++)] = static_cast<Count>(at);
  }
};

}  // namespace sublimit
