// SPDX-License-Identifier: Apache-2.0
#pragma once
// Sides of patches that lie on parts of others (T-junctions): where the longer ones are to be cut, so that the parts
// between cuts are one curve in one parameter.
#include <span>
#include <vector>

#include "sublimit/patches/joins/patch_seams.h"

namespace sublimit {

PatchSide side_of(const PatchLine& line);
/// Returns the global number of a patch side: `4 * patch + side`.
inline size_t side_number(const PatchLine& line) { return 4 * line.patch + size_t(side_of(line)); }

/// Parameters of each side at its ends and at the corners of other patches that lie on it, ascending.
/// @param seams  of kind `partial` are looked at
/// @param same   distance of points that are one
std::vector<std::vector<double>> side_cuts(std::span<const PatchColumns> patches, Coordinates coordinates,
                                           const PatchSeams& seams, double same);

struct SidePart {
  PatchLine line;
  double begin = 0, end = 0;  ///< parameters of the side
};
struct PartDistance {
  bool reversed = false;
  double distance = 0;  ///< largest, at proportional parameters
};
/// Returns the distance of two parts of sides, in the direction in which they are nearer.
PartDistance part_distance(std::span<const PatchColumns> patches, Coordinates coordinates, const SidePart& a,
                           const SidePart& b);

}  // namespace sublimit
