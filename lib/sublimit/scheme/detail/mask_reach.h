// SPDX-License-Identifier: Apache-2.0
#pragma once
// How far the masks of a scheme reach: they are applied once to labelled meshes, and the points that they use are
// looked at. A mask may use child points that other masks have made, and a level may have several steps: what masks are
// given does not say how far all of them together reach.
#include <map>
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

/// A row of a subdivision matrix, by vertices.
using MaskRow = std::map<Index, double>;
/// Returns a row without its zeros.
/// @param number  number of each vertex of a part in the whole; null: the matrix is of the whole
MaskRow row_of(const SparseMatrix& S, Index v, const std::vector<Index>* number = nullptr);
/// Returns true if two rows have the same vertices, and the same weights up to rounding.
bool has_same_weights(const MaskRow& a, const MaskRow& b);

/// More rings of faces than any scheme should need.
constexpr int most_rings = 12;

}  // namespace sublimit
