// SPDX-License-Identifier: Apache-2.0
#pragma once
// The points around a centre in canonical order, ring by ring and counter-clockwise, with a signature of their
// connectivity: the shapes of the fans, and which corners are the same point. Equal signatures imply equal
// limits.
#include <cstdint>
#include <vector>

#include "sublimit/mesh/sharpness.h"
#include "sublimit/neighborhood/centre.h"

namespace sublimit {

/// Result of a walk around a centre.
struct Walk {
  std::vector<Index> vertices;  ///< by slot: the centre's own first (vertex; corners of the face; ends of the edge)
  std::vector<Index> ring_end;  ///< number of slots of rings 0 to r, for each r
  std::vector<bool> on_border;  ///< by slot, for the slots whose fans were walked
  std::vector<std::uint32_t> signature;
  bool decays = false;  ///< true if there is finite sharpness, so that the next level differs
};

/// Walks the fans of the points in rings 0 to depth - 1, which gives the points up to ring `depth`. Infinitely
/// sharp edges cut fans, as boundaries do. A non-manifold vertex has a slot for each of its fans that is met.
/// @param expected  signature to compare with, if given: the walk stops at the first difference. This spares
///                  neighbours of a vertex of a thousand faces the walk around it
Walk walk(const Topology& topology, const Sharpness& sharpness, const Centre& centre, int depth,
          const std::vector<std::uint32_t>* expected = nullptr);

}  // namespace sublimit
