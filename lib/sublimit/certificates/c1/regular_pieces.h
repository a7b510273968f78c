// SPDX-License-Identifier: Apache-2.0
#pragma once
// The polynomials of a scheme's limit on regular meshes, computed from its mask alone and verified.
//
// Limit values at corners are left eigenvectors of the mask; refinement gives those at all dyadic places, and
// enough of them determine one polynomial per piece: Bernstein coefficients = M * control points. It is the
// limit if
//
//   M_child S = D M         exactly, for every child of every piece (S the rows of the mask, D de Casteljau onto it)
//
// and the rows of M sum to one: the points of level k converge to the limit around the piece, so M applied to
// them gives coefficients that converge to the limit too, and by the equation these are coefficients of the
// same polynomial.
#include <array>
#include <optional>
#include <vector>

#include "sublimit/certificates/numbers/algebraic.h"
#include "sublimit/core/detail/bernstein.h"
#include "sublimit/neighborhood/regular_mask.h"

namespace sublimit {

/// A kind of piece, in the cell at the origin.
struct RegularPiece {
  PieceShape shape = PieceShape::square;
  std::array<LatticePoint, 3> corners;          ///< corners u = v = 0, u = 1, v = 1
  std::vector<LatticePoint> controls;           ///< control points that it depends on
  std::vector<Bernstein<Algebraic>> functions;  ///< function of each control point: a column of M
};

/// All kinds of pieces of a scheme.
struct RegularPieces {
  RegularMask<Algebraic> mask;
  int degree = 0;      ///< degree in each parameter (squares), or total degree (triangles)
  int continuity = 0;  ///< exact k of C^k across all edges; at least the degree if all pieces are one polynomial
  std::vector<RegularPiece> pieces;
};

/// A child of piece `parent`: piece `piece` of cell `cell` in the refined plane, with its corners as places of
/// the parent.
struct ChildPiece {
  size_t parent, piece;
  LatticePoint cell;
  std::array<PiecePlace<Algebraic>, 3> corners;
};
/// Returns the children of all pieces.
std::vector<ChildPiece> child_pieces(const std::vector<RegularPiece>& pieces, int dilation = 2);

/// Returns kinds of pieces without polynomials: squares, or triangles.
std::vector<RegularPiece> squares();
std::vector<RegularPiece> triangles();

/// Returns the pieces of a mask as squares, triangles, or squares cut into four triangles, of the least
/// possible degree up to `most`; nothing if none satisfies the equation.
std::optional<RegularPieces> regular_pieces(const RegularMask<Algebraic>& mask, int most = 6);

}  // namespace sublimit
