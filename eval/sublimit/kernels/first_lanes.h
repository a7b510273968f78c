// SPDX-License-Identifier: Apache-2.0
#pragma once
// Which lanes a mask has.
#include <array>
#include <cstddef>

namespace sublimit::kernels {

/// [mask]: the lanes that it has, ascending.
template <class Int, size_t Lanes>
inline constexpr auto first_lanes = [] {
  std::array<std::array<Int, Lanes>, (1u << Lanes)> lanes{};
  for (size_t mask = 0; mask < lanes.size(); ++mask)
    for (size_t lane = 0, count = 0; lane < Lanes; ++lane)
      if (mask >> lane & 1) lanes[mask][count++] = static_cast<Int>(lane);
  return lanes;
}();

}  // namespace sublimit::kernels
