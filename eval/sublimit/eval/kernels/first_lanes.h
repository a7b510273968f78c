// SPDX-License-Identifier: Apache-2.0
#pragma once
// Lists of the lanes of a mask.
#include <array>
#include <cstddef>

namespace sublimit::kernels {

/// Lanes of each mask, ascending: first_lanes[mask].
template <class Int, size_t Lanes>
inline constexpr auto first_lanes = [] {
  std::array<std::array<Int, Lanes>, (1u << Lanes)> lanes{};
  for (size_t mask = 0; mask < lanes.size(); ++mask)
    for (size_t lane = 0, count = 0; lane < Lanes; ++lane)
      if (mask >> lane & 1) lanes[mask][count++] = static_cast<Int>(lane);
  return lanes;
}();

}  // namespace sublimit::kernels
