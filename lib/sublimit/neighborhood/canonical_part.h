// SPDX-License-Identifier: Apache-2.0
#pragma once
// A part of a level renumbered by slot. Sums over neighbours follow the numbering, so that rows of a type have
// the same bits whichever of its pieces they are computed from.
#include <vector>

#include "sublimit/scheme/refine.h"

namespace sublimit {

/// A renumbered part of a level.
struct CanonicalPart {
  Level level;                   ///< vertex i is slot i; vertices without a slot follow
  std::vector<Index> half_edge;  ///< new half-edge of each half-edge of the part
};

/// Returns a part renumbered such that its first vertices are `slots`.
/// @param slots  vertices of the part in their new order
CanonicalPart canonical_part(const Level& part, const std::vector<Index>& slots);

}  // namespace sublimit
