// SPDX-License-Identifier: Apache-2.0
#pragma once
// Break points of closed splines from their intervals.
#include <vector>

namespace sublimit::testing {

/// Returns the break points from 0 on, one more than intervals.
inline std::vector<double> breaks_of(const std::vector<double>& lengths) {
  std::vector<double> breaks{0};
  for (const double d : lengths) breaks.push_back(breaks.back() + d);
  return breaks;
}

/// Returns the break points with a new one in each interval.
/// @param at  distance of each new break point from the start of its interval
inline std::vector<double> finer_breaks(const std::vector<double>& lengths, const std::vector<double>& at) {
  std::vector<double> fine;
  const std::vector<double> breaks = breaks_of(lengths);
  for (size_t i = 0; i < lengths.size(); ++i) fine.insert(fine.end(), {breaks[i], breaks[i] + at[i]});
  fine.push_back(breaks.back());
  return fine;
}

}  // namespace sublimit::testing
