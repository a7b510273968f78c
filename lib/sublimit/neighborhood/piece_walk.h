// SPDX-License-Identifier: Apache-2.0
#pragma once
// The points that a piece of the limit depends on, in an order of their own, and the signature of what they are: equal
// signatures, equal stencils. Sharpness enters by its float bits, whatever its size.
#include <cstdint>
#include <vector>

#include "sublimit/mesh/sharpness.h"
#include "sublimit/neighborhood/piece.h"
#include "sublimit/scheme/refine.h"

namespace sublimit {

struct PieceWalk {
  std::vector<Index> vertices;  ///< by slot: the piece's own first, then ring by ring
  std::vector<std::uint32_t> signature;
  int rings = 1;        ///< of faces around the piece
  size_t inner = 0;     ///< points that stand before those of the last ring
  bool decays = false;  ///< some finite sharpness matters
  bool apart = false;   ///< sheets that are apart (`are_sheets_apart`) were walked around where they were met
};

/// Walks the faces around the points of rings 0 to rings - 1. One walker for each thread: it keeps its memory.
class PieceWalker {
 public:
  /// @param phase  of the level, modulo the period of the scheme
  const PieceWalk& walk(const Topology& topology, const Sharpness& sharpness, const Piece& piece, int rings, int phase);
  /// Walks around a piece whose knot intervals may differ: then two rings at least, with the intervals up to a power of
  /// two. Else each sheet for itself, if the level allows it (`may_part_sheets`).
  /// @param rings  that a piece depends on where they are equal
  const PieceWalk& walk(const Level& level, const Piece& piece, int rings, int period);

 private:
  const PieceWalk& walk(const Topology& topology, const Sharpness& sharpness, const Piece& piece, int rings, int phase,
                        bool apart);
  /// Returns the slot of the tail, and in `is_new` whether it has not been met before.
  Index slot(HalfEdge h, bool& is_new);
  /// Adds the intervals around the points that were walked around; false if all are equal, and stay so.
  bool add_intervals(const KnotIntervals& intervals, const Piece& piece, size_t points);
  const Topology* t_ = nullptr;
  PieceWalk walk_;
  /// A half-edge for each point that is walked around, in that order, which leaves it: by slot; of points whose sheets
  /// are apart one for each sheet.
  std::vector<HalfEdge> found_at_;
  std::vector<std::uint32_t> stamp_, slot_;  // by vertex
  std::uint32_t now_ = 0;
};

}  // namespace sublimit
