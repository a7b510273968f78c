// SPDX-License-Identifier: Apache-2.0
#pragma once
// Cuts of the sides of patches at T-junctions, such that the parts between cuts are the same curve in the same
// parameter.
#include <span>
#include <vector>

#include "sublimit/patches/joins/patch_seams.h"

namespace sublimit {

/// Returns the side of a patch that a line is.
PatchSide side_of(const PatchLine& line);
/// Returns the global number of a patch side: `4 * patch + side`.
inline size_t side_number(const PatchLine& line) { return 4 * line.patch + size_t(side_of(line)); }

/// Returns for each side the parameters of its ends and of the corners of other patches on it, ascending.
/// @param seams  seams of the patches; those of kind `partial` are used
/// @param same   distance up to which points count as the same
std::vector<std::vector<double>> side_cuts(std::span<const PatchColumns> patches, Coordinates coordinates,
                                           const PatchSeams& seams, double same);

/// A part of a side.
struct SidePart {
  PatchLine line;
  double begin = 0, end = 0;  ///< its ends, as parameters of the side
};
/// Distance of two parts.
struct PartDistance {
  bool reversed = false;  ///< true if the parts run in opposite directions
  double distance = 0;    ///< largest distance at proportional parameters
};
/// Returns the distance of two parts of sides, in the direction in which it is smaller.
PartDistance part_distance(std::span<const PatchColumns> patches, Coordinates coordinates, const SidePart& a,
                           const SidePart& b);

}  // namespace sublimit
