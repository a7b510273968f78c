// SPDX-License-Identifier: Apache-2.0
#pragma once
// Sizes of levels, checked before memory is taken.
#include <cmath>

#include "sublimit/scheme/scheme.h"

namespace sublimit {

/// Data in memory while the last level is made.
enum class LevelMemory {
  matrices,  ///< all levels, with matrices and positions
  points,    ///< the last two, with positions
  mesh,      ///< the last one's faces and positions, and the one before
};

/// Checks what `refine` checks before the first level is made, for code that makes levels one by one.
/// @throws InvalidParameter  negative `levels`
/// @throws ResourceError     more elements than 32-bit indices, or more memory than the machine has
void check_levels(const Scheme<double>& scheme, const Topology& control, int levels,
                  LevelMemory memory = LevelMemory::matrices);

/// Levels that may be made of something if the last one shall have no more than `limit`, level 0 has `first` of it and
/// every level `factor` times as many as the one before.
inline int most_levels(double first, double factor, double limit) {
  return first > limit ? 0 : static_cast<int>(std::log(limit / first) / std::log(factor));
}

}  // namespace sublimit
