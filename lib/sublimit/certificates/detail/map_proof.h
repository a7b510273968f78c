// SPDX-License-Identifier: Apache-2.0
#pragma once
// A characteristic map is regular and injective: what is to be checked, and checked in balls.
//
// On one sector between rings r and 2 r the map consists of polynomials. (1) Their Jacobian determinants are positive:
// Bernstein coefficients are, after subdivision. (2) The outer boundary of the sector goes from p to exp(2 pi i/n) p
// inside a half-plane through 0, so the whole closed curve winds once around 0. By rotation and dilation (1) holds
// around the whole centre, and so does (2) for the curve dilated by 2^k. The map is C^1 off the centre, so by (1) each
// point y has as many preimages within the curve as the curve's image winds around y. For y = 0 this is one: the
// centre. And for any y it is what it is for 0, once the curve is large: one. So the map is injective. (Reif 1995;
// Peters, Reif 1998; Zorin 2000 argue in the same way with monotone arguments.)
#include <string>
#include <vector>

#include "sublimit/certificates/detail/characteristic_map.h"
#include "sublimit/certificates/detail/derivative_tail.h"
#include "sublimit/certificates/detail/regular_pieces.h"

namespace sublimit {

/// Functions of all pieces in balls: by piece, by control point.
using BallFunctions = std::vector<std::vector<Bernstein<Ball>>>;
BallFunctions in_balls(const RegularPieces& pieces);

/// A part of a piece where the sign is known: quarters of quarters, as digits ("" is all of it, "03" a sixteenth).
struct SignedLeaf {
  size_t piece;  ///< in `MapProof::placed`
  std::string path;
  Ball least, greatest;  ///< of the Bernstein coefficients of the Jacobian there
};

struct MapProof {
  int ring = 1;  ///< r
  std::vector<PlacedPiece> placed;
  std::vector<SignedLeaf> leaves;
  enum class Regular { yes, folds, unknown } regular = Regular::unknown;
  bool winds_once = false;
  Ball least, greatest;  ///< of the Jacobian: lower bound and upper bound are those of the balls
  int level = 0;         ///< of refinement that was needed, of nets
  size_t parts = 0;      ///< where the sign was found
  std::string fold;      ///< where the determinant is negative although it is positive elsewhere, for people
  bool holds() const { return regular == Regular::yes && winds_once; }
};

/// The Bernstein polynomials x and y of a piece of the map.
struct MapPiece {
  Bernstein<Ball> x, y;
};
std::optional<MapPiece> map_piece(CharacteristicMap& map, const RegularPieces& pieces, const BallFunctions& functions,
                                  const PlacedPiece& placed);

/// Jacobian determinant by u and v.
Bernstein<Ball> jacobian(const MapPiece& piece);

/// Edges of a piece on the outer boundary of the sector, by their ends in u and v.
std::vector<std::array<PiecePlace<Ball>, 2>> outer_edges(const RegularPiece& piece, LatticePoint cell, int ring,
                                                         bool triangular);
/// Bernstein coefficients along an edge; those of a triangle or square without extent across it.
Bernstein<Ball> along(const Bernstein<Ball>& f, const std::array<PiecePlace<Ball>, 2>& edge);

/// @param ring  `regular_ring` of the neighbourhood
MapProof prove_map(CharacteristicMap& map, const RegularPieces& pieces, const BallFunctions& functions, int ring);

/// Proves the same of a characteristic map without polynomials, from refined nets: derivatives lie within the tail of
/// differences. The
/// net of level k is the net itself between rings D^k r and D^(k+1) r, times lambda^k, so it is only looked at further
/// out. Of interpolating schemes; others get no winding. Leaves are all kept as numbers of the finest level needed, no
/// paths.
/// @param ring    `regular_ring` with `tail.pieces`
/// @param levels  up to which nets are refined
MapProof prove_map(CharacteristicMap& map, const DerivativeTail& tail, int ring, int levels);

/// Signs of the determinants of the edges of refined nets between rings D^level r and D^(level+1) r, in floating point:
/// evidence, no proof.
struct NetSigns {
  int level = 0;
  long positive = 0, negative = 0;
  double least = 0;  ///< determinant relative to the mean one
};
std::optional<NetSigns> net_signs(CharacteristicMap& map, int ring, int level);

}  // namespace sublimit
