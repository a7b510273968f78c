// SPDX-License-Identifier: Apache-2.0
#pragma once
// Arguments of kernels, as the host writes them.
#include <cstdint>

namespace sublimit::gpu {

using uint = std::uint32_t;
inline constexpr int threads = 64;  ///< threads of a workgroup
#define ADDRESS std::uint64_t
#include "sublimit/eval/gpu/kernels/arguments.inc"
#undef ADDRESS
static_assert(sizeof(Arguments) == 128);

/// Advances arguments by a number of frames.
inline void advance_frames(Arguments& arguments, int frames, bool half) {
  arguments.points += std::uint64_t(frames) * arguments.in_frame * 4;
  for (std::uint64_t& result : arguments.results)
    if (result != 0) result += std::uint64_t(frames) * arguments.out_frame * (half ? 2 : 4);
}

}  // namespace sublimit::gpu
