// SPDX-License-Identifier: Apache-2.0
#pragma once
// How far the masks of a scheme reach: they are applied once to labelled meshes, and the points that they use are
// looked at. A mask may use child points that other masks have made, and a level may have several steps: what masks are
// given does not say how far all of them together reach.
#include <vector>

#include "sublimit/scheme/refine.h"

namespace sublimit {

/// A level, refined by one period, and some of its faces that are unlike each other.
struct LabelledLevel {
  Level level;
  std::vector<Level> period;  ///< the levels that follow, with their matrices
  std::vector<Index> faces;
};
/// Returns levels around vertices and faces of several valences, with borders, and with sharp edges if the scheme has
/// rules for them. They are so large that no neighbourhood overlaps itself.
std::vector<LabelledLevel> labelled_levels(const Scheme<double>& scheme);

/// True if no mask sees more than the faces of its own element, and a level has one step: what sites are given then
/// bounds the reach of masks.
bool has_narrow_masks(const Scheme<double>& scheme);

/// More rings of faces than any scheme should need.
constexpr int most_rings = 12;

}  // namespace sublimit
