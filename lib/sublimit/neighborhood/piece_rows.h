// SPDX-License-Identifier: Apache-2.0
#pragma once
// Rows of the limit at a place of a piece: down through the children that have the place, then back up through their
// blocks.
#include <vector>

#include "sublimit/neighborhood/piece_types.h"

namespace sublimit {

/// True if polynomials meet at a place: on a side of its piece, or on the line that cuts the piece in two.
/// @param dual    the scheme is dual: the polynomial of a piece continues across the sides at its vertex
/// @param halves  pieces are cut along u = v
inline bool is_on_knot(const PieceCoordinates& p, bool triangle, bool dual, bool halves) {
  if (triangle) return p.u == 0 || p.v == 0 || p.u1 == 0;
  return p.u1 == 0 || p.v1 == 0 || (!dual && (p.u == 0 || p.v == 0)) || (halves && p.u == p.v);
}

/// Converts derivative rows by the parameters of a child to those by the parameters of its parent, in place.
void apply_chain(const PieceMap::Chain& chain, RowMatrix& rows);

/// Converts tangent rows of a child to those of its parent, in place.
void turn_tangents(const PieceMap::Chain& chain, RowMatrix& tangents);

/// The way from a piece to where its limit is known at a place: through children that have the place, to a polynomial
/// or to a corner.
struct PieceDescent {
  struct Step {
    const PieceType* from;
    const PieceLink* link;
    PieceCoordinates place;  ///< in `from`
    int times;               ///< number of times that the link is taken, if it repeats
  };
  std::vector<Step> steps;
  const PieceType* type = nullptr;              ///< type where the way ends
  PieceCoordinates place;                       ///< the place in it
  const PiecePolynomial* polynomial = nullptr;  ///< its polynomial; null if the way ends at a corner
  int corner = -1;                              ///< the corner
  bool at_corner = false;  ///< true if the place is the corner; false if it is too near to it to be told apart
};
/// Returns the way to a place.
/// @param search  true: decide whether pieces are polynomials; false: use only polynomials that are known already
PieceDescent descend(const PieceType& type, PieceCoordinates place, bool search = true);

/// Rows of a place, over differences of the points of its piece.
struct PieceRows {
  RowMatrix rows;      ///< position, then u, v, then uu, uv, vv
  RowMatrix tangents;  ///< if order >= 1: rows that span the tangent plane: u and v, up to factors that keep the normal
  int order = 0;       ///< highest derivative that exists: 0, 1 or 2
  bool at_corner = false;  ///< a corner without a polynomial: tangents may come from limit masks
  bool on_knot = false;    ///< polynomials meet here: second derivatives may jump
};
/// Returns the rows at a place of a piece of a type.
/// @param order   highest derivative, 0 to 2
/// @param search  true: decide whether pieces are polynomials; false: use only polynomials that are known
///                already
/// @throws AnalysisError  no limit
PieceRows piece_rows(const PieceType& type, PieceCoordinates place, int order, bool search = true);

}  // namespace sublimit
