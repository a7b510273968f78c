// SPDX-License-Identifier: Apache-2.0
#pragma once
// The points that a piece of the limit depends on, in an order of their own, and the signature of what they are: equal
// signatures, equal stencils. Sharpness enters by its float bits, whatever its size.
#include <cstdint>
#include <vector>

#include "sublimit/mesh/sharpness.h"
#include "sublimit/neighborhood/piece.h"

namespace sublimit {

struct PieceWalk {
  std::vector<Index> vertices;  ///< by slot: the piece's own first, then ring by ring
  std::vector<std::uint32_t> signature;
  bool decays = false;  ///< some finite sharpness matters
};

/// Walks the faces around the points of rings 0 to rings - 1. One walker for each thread: it keeps its memory.
class PieceWalker {
 public:
  /// @param phase  of the level, modulo the period of the scheme
  const PieceWalk& walk(const Topology& topology, const Sharpness& sharpness, const Piece& piece, int rings, int phase);

 private:
  Index slot(HalfEdge h);
  const Topology* t_ = nullptr;
  PieceWalk walk_;
  std::vector<HalfEdge> found_at_;           // by slot: a half-edge that leaves the point
  std::vector<std::uint32_t> stamp_, slot_;  // by vertex
  std::uint32_t now_ = 0;
};

}  // namespace sublimit
