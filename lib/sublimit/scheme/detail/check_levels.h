// SPDX-License-Identifier: Apache-2.0
#pragma once
// Checks of the sizes of levels before memory is allocated.
#include <cmath>

#include "sublimit/scheme/scheme.h"

namespace sublimit {

/// Data that is in memory while the last level is made.
enum class LevelMemory {
  matrices,  ///< all levels, with matrices and positions
  points,    ///< the last two levels, with positions
  mesh,      ///< faces and positions of the last level, and the level before
};

/// Throws unless `levels` levels can be made, as `refine` does first; for code that makes levels one by one.
/// @throws InvalidParameter  negative `levels`
/// @throws ResourceError     more elements than 32-bit indices count, or more memory than the machine has
void check_levels(const Scheme<double>& scheme, const Topology& control, int levels,
                  LevelMemory memory = LevelMemory::matrices);

/// Returns the largest number of levels such that the last one has at most `limit` elements, if level 0 has
/// `first`, and every level `factor` times as many as the one before.
inline int most_levels(double first, double factor, double limit) {
  return first > limit ? 0 : static_cast<int>(std::log(limit / first) / std::log(factor));
}

}  // namespace sublimit
