// SPDX-License-Identifier: Apache-2.0
#pragma once
// Pieces of a limit surface. In primal schemes a quadrilateral or triangular face is a piece, and so is the
// square at each corner of any other polygon; in dual schemes the square at each corner of a face. Refinement
// divides a piece into children.
#include <span>
#include <vector>

#include "sublimit/mesh/knot_intervals.h"
#include "sublimit/neighborhood/piece_map.h"
#include "sublimit/splits/split.h"

namespace sublimit {

/// A piece of a level.
struct Piece {
  enum class Kind : std::uint8_t {
    quad,      ///< a whole face: (0,0) at the tail of `start`, (1,0) at its head
    triangle,  ///< a whole face: (0,0) and (1,0) as above, (0,1) at the third corner
    corner,    ///< dual schemes: the square at the tail of `start`; u along `start`, (1,1) in the middle of the face
    cut,       ///< primal schemes: the same square at a corner of a polygon; its child is a `quad`
  };
  Kind kind = Kind::quad;
  HalfEdge start = no_half_edge;
};

/// Returns the place of a corner of a piece; corners count counter-clockwise from (0,0).
PieceCoordinates corner_place(Piece::Kind kind, int corner);
/// Returns the corner that a place is at, or -1.
int corner_at(Piece::Kind kind, const PieceCoordinates& place);
/// Returns the corner that is nearest to a place.
int nearest_corner(Piece::Kind kind, const PieceCoordinates& place);

/// A child of a piece.
struct PieceChild {
  Piece piece;   ///< piece of the refined level
  PieceMap map;  ///< from parameters of the parent to those of the child
};

/// A refinement, and the number and knots of the level that it refines.
struct LevelStep {
  const Refinement* refinement;
  int level;
  const KnotSplit* knots = nullptr;        ///< new knots; null: in the middle of their intervals
  const KnotSplit* child_knots = nullptr;  ///< new knots of the refined level; null: likewise
};

/// Returns the children of a piece after one period of its scheme.
/// @param parent  topology of the level of the piece
/// @param steps   refinements of one period, starting from `parent`
/// @throws AnalysisError  children do not tile their parent
std::vector<PieceChild> children(const Piece& piece, const Topology& parent, std::span<const LevelStep> steps);

}  // namespace sublimit
