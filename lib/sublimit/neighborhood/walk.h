// SPDX-License-Identifier: Apache-2.0
#pragma once
// The points around a centre in a canonical order, ring by ring, counter-clockwise, and the signature of what was seen:
// the shapes of the fans and which corners are the same point. Equal signatures, equal limits.
#include <cstdint>
#include <vector>

#include "sublimit/mesh/sharpness.h"
#include "sublimit/neighborhood/centre.h"

namespace sublimit {

struct Walk {
  std::vector<Index> vertices;  ///< by slot: the centre's own first (vertex; corners of the face; ends of the edge)
  std::vector<Index> ring_end;  ///< slots of rings 0 to r
  std::vector<bool> on_border;  ///< by slot, of the slots whose fans were walked
  std::vector<std::uint32_t> signature;
  bool decays = false;  ///< finite sharpness was met: the next level looks otherwise
};

/// Walks the fans of the points in rings 0 to depth - 1, which finds ring `depth`. Infinitely sharp edges cut fans, as
/// boundaries do; a non-manifold vertex has a slot for each of its fans that is met.
/// @param expected  a signature that the walk is wanted for: it ends as soon as it meets something else, so that the
///                  neighbours of a vertex of a thousand faces do not walk around it
Walk walk(const Topology& topology, const Sharpness& sharpness, const Centre& centre, int depth,
          const std::vector<std::uint32_t>* expected = nullptr);

}  // namespace sublimit
