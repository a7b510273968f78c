// SPDX-License-Identifier: Apache-2.0
#pragma once
// Proof in balls that a characteristic map is regular and injective.
//
// On one sector between rings r and 2 r the map consists of polynomials. It is proved that (1) their Jacobian
// determinants are positive, since their Bernstein coefficients are, after subdivision; (2) the outer boundary
// of the sector goes from p to exp(2 pi i/n) p inside a half-plane through 0, so the whole closed curve winds
// once around 0. By rotation and dilation (1) holds around the whole centre, and (2) for the curve dilated by
// any 2^k. The map is C^1 except at the centre, so by (1) the number of preimages of a point y within the curve
// is the winding number of the curve's image around y. For y = 0 it is one: the centre. For any other y it is
// the same as for 0 if the curve is large enough: one. Hence the map is injective. (Reif 1995; Peters, Reif
// 1998; Zorin 2000 use similar arguments with monotone curves.)
#include <string>
#include <vector>

#include "sublimit/certificates/c1/characteristic_map.h"
#include "sublimit/certificates/c1/derivative_tail.h"
#include "sublimit/certificates/c1/regular_pieces.h"

namespace sublimit {

/// Functions of all pieces in balls, by piece and control point.
using BallFunctions = std::vector<std::vector<Bernstein<Ball>>>;
/// Returns the functions of all pieces in balls.
BallFunctions in_balls(const RegularPieces& pieces);

/// A part of a piece on which the sign of the Jacobian is known.
struct SignedLeaf {
  size_t piece;          ///< index in `MapProof::placed`
  std::string path;      ///< numbers of quarters of quarters: "" is the whole piece, "03" a sixteenth
  Ball least, greatest;  ///< least and greatest Bernstein coefficient of the Jacobian on the part
};

/// Result of a proof.
struct MapProof {
  int ring = 1;  ///< r
  std::vector<PlacedPiece> placed;
  std::vector<SignedLeaf> leaves;
  enum class Regular { yes, folds, unknown } regular = Regular::unknown;
  bool winds_once = false;
  Ball least, greatest;  ///< bounds of the Jacobian: the lower end of `least`, and the upper end of `greatest`
  int level = 0;         ///< level of refinement that nets needed
  size_t parts = 0;      ///< number of parts on which the sign was decided
  std::string fold;      ///< description of a place with a negative determinant, if it is positive elsewhere
  bool holds() const { return regular == Regular::yes && winds_once; }
};

/// The Bernstein polynomials x and y of a piece of the map.
struct MapPiece {
  Bernstein<Ball> x, y;
};
/// Returns the polynomials of a piece; nothing if the net does not reach it.
std::optional<MapPiece> map_piece(CharacteristicMap& map, const RegularPieces& pieces, const BallFunctions& functions,
                                  const PlacedPiece& placed);

/// Returns the Jacobian determinant of a piece by u and v.
Bernstein<Ball> jacobian(const MapPiece& piece);

/// Returns the edges of a piece on the outer boundary of the sector, by their ends in u and v.
std::vector<std::array<PiecePlace<Ball>, 2>> outer_edges(const RegularPiece& piece, LatticePoint cell, int ring,
                                                         bool triangular);
/// Returns the polynomial along an edge, as one over a triangle or square that is collapsed to the edge.
Bernstein<Ball> along(const Bernstein<Ball>& f, const std::array<PiecePlace<Ball>, 2>& edge);

/// Proves a characteristic map regular and injective.
/// @param ring  `regular_ring` of the neighbourhood
MapProof prove_map(CharacteristicMap& map, const RegularPieces& pieces, const BallFunctions& functions, int ring);

/// Proves the same for a scheme without polynomials, from refined nets with the error bound `tail` of their
/// differences.
///
/// The net of level k is the net itself between rings D^k r and D^(k+1) r, times lambda^k, so no refinement is
/// needed. The winding number is proved for interpolating schemes only. Leaves have no paths; all bounds are
/// those of the finest level.
/// @param ring    `regular_ring` with `tail.pieces`
/// @param levels  largest level of nets
MapProof prove_map(CharacteristicMap& map, const DerivativeTail& tail, int ring, int levels);

/// Signs of the determinants of edges of refined nets between rings D^level r and D^(level+1) r, in
/// floating-point arithmetic: evidence, no proof.
struct NetSigns {
  int level = 0;
  long positive = 0, negative = 0;
  double least = 0;  ///< least determinant, divided by the mean
};
std::optional<NetSigns> net_signs(CharacteristicMap& map, int ring, int level);

}  // namespace sublimit
