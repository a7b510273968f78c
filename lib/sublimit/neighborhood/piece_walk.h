// SPDX-License-Identifier: Apache-2.0
#pragma once
// The points that a piece of the limit depends on, in canonical order, with a signature of their connectivity,
// sharpness and knot intervals. Pieces with equal signatures have equal stencils. Sharpness enters by the bits
// of its float.
#include <cstdint>
#include <vector>

#include "sublimit/mesh/sharpness.h"
#include "sublimit/neighborhood/piece.h"
#include "sublimit/scheme/refine.h"

namespace sublimit {

/// Result of a walk around a piece.
struct PieceWalk {
  std::vector<Index> vertices;  ///< by slot: the piece's own first, then ring by ring
  std::vector<std::uint32_t> signature;
  int rings = 1;        ///< rings of faces around the piece
  size_t inner = 0;     ///< number of points inside the last ring; they are first
  bool decays = false;  ///< true if the signature has finite sharpness
  bool apart = false;   ///< at vertices of separate sheets (`are_sheets_apart`) only sheets that were met are included
};

/// Walks the faces around the points of rings 0 to rings - 1. Reuses its memory: use one walker per thread. A
/// result is valid until the next walk.
class PieceWalker {
 public:
  /// Walks around a piece between equal knot intervals.
  /// @param phase  number of the level modulo the period of the scheme
  const PieceWalk& walk(const Topology& topology, const Sharpness& sharpness, const Piece& piece, int rings, int phase);
  /// Walks around a piece whose knot intervals may differ. If they do, the walk has at least two rings, and its
  /// signature contains the intervals up to a common power of two. Else separate sheets are walked separately,
  /// if the level allows it (`may_part_sheets`).
  /// @param rings  rings that a piece depends on if intervals are equal
  const PieceWalk& walk(const Level& level, const Piece& piece, int rings, int period);

 private:
  const PieceWalk& walk(const Topology& topology, const Sharpness& sharpness, const Piece& piece, int rings, int phase,
                        bool apart);
  /// Returns the slot of the tail, and in `is_new` whether it has not been met before.
  Index slot(HalfEdge h, bool& is_new);
  /// Adds the intervals around the first `points` points to the signature. Returns false if all are equal and
  /// stay so.
  bool add_intervals(const KnotIntervals& intervals, const Piece& piece, size_t points);
  const Topology* t_ = nullptr;
  PieceWalk walk_;
  /// An outgoing half-edge of each point to walk around, by slot; for points with separate sheets one per
  /// sheet.
  std::vector<HalfEdge> found_at_;
  std::vector<std::uint32_t> stamp_, slot_;  // by vertex
  std::uint32_t now_ = 0;
};

}  // namespace sublimit
