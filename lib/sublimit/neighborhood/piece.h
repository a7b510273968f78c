// SPDX-License-Identifier: Apache-2.0
#pragma once
// Pieces: what a limit surface is made of. In primal schemes a piece is a quadrilateral or a triangle, in dual ones the
// quarter of a face at one corner, and so is the square at a corner of any other polygon. Refinement cuts a piece into
// children.
#include <span>
#include <vector>

#include "sublimit/mesh/knot_intervals.h"
#include "sublimit/neighborhood/piece_map.h"
#include "sublimit/splits/split.h"

namespace sublimit {

struct Piece {
  enum class Kind : std::uint8_t {
    quad,      ///< of a face: (0,0) at the tail of `start`, (1,0) at its head
    triangle,  ///< the same, (0,1) at the third corner
    corner,    ///< the square at the tail of `start`, (1,1) in the middle of its face; u along `start`
    cut,       ///< the same in a primal scheme: one step on it is a quad
  };
  Kind kind = Kind::quad;
  HalfEdge start = no_half_edge;
};

struct PieceChild {
  Piece piece;  ///< of the refined level
  PieceMap map;
};

/// A refinement and the level that it refines.
struct LevelStep {
  const Refinement* refinement;
  int level;
  const KnotSplit* knots = nullptr;        ///< null: new ones are in the middle
  const KnotSplit* child_knots = nullptr;  ///< of the refined level; null: the same
};

/// Children of a piece after one period of its scheme.
/// @param steps  of one period, from `parent` on
/// @throws AnalysisError  children that do not tile their parent
std::vector<PieceChild> children(const Piece& piece, const Topology& parent, std::span<const LevelStep> steps);

}  // namespace sublimit
