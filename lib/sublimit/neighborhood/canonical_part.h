// SPDX-License-Identifier: Apache-2.0
#pragma once
// A part of a level in the order of its slots, so that a type has the same bits whichever of its pieces was met first:
// sums over neighbours are taken in the order of their numbers.
#include <vector>

#include "sublimit/scheme/refine.h"

namespace sublimit {

struct CanonicalPart {
  Level level;                   ///< vertex i is slot i; those that are no slots come after
  std::vector<Index> half_edge;  ///< of every one of the part's
};

/// @param slots  vertices of the part in their new order
CanonicalPart canonical_part(const Level& part, const std::vector<Index>& slots);

}  // namespace sublimit
