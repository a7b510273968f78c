// SPDX-License-Identifier: Apache-2.0
#pragma once
// The polynomials that a scheme's limit on regular meshes consists of, found from its mask alone and then verified.
//
// Limit values at corners are left eigenvectors of the mask; refinement carries them to all dyadic places, and through
// enough of them goes one polynomial a piece: Bernstein coefficients = M * control points. It is the limit if
//
//   M_child S = D M         exactly, for every child of every piece (S the rows of the mask, D de Casteljau onto it)
//
// and rows of M sum to one: then M applied to the points of level k, which converge to the limit around the piece,
// gives coefficients that all converge to the limit there, and are those of the one polynomial.
#include <array>
#include <optional>
#include <vector>

#include "sublimit/certificates/algebraic.h"
#include "sublimit/certificates/detail/bernstein.h"
#include "sublimit/neighborhood/regular_mask.h"

namespace sublimit {

/// A kind of piece, in the cell whose least corner is the origin.
struct RegularPiece {
  PieceShape shape = PieceShape::square;
  std::array<LatticePoint, 3> corners;          ///< u = v = 0, u = 1, v = 1
  std::vector<LatticePoint> controls;           ///< the points that it depends on
  std::vector<Bernstein<Algebraic>> functions;  ///< by control point: a column of M
};

struct RegularPieces {
  RegularMask<Algebraic> mask;
  int degree = 0;      ///< of each coordinate (squares), or in all (triangles)
  int continuity = 0;  ///< C^continuity across all edges, exactly; at least the degree where pieces are one polynomial
  std::vector<RegularPiece> pieces;
};

/// A child of piece `parent`: piece `piece` of cell `cell` in the refined plane, at these places of the parent.
struct ChildPiece {
  size_t parent, piece;
  LatticePoint cell;
  std::array<PiecePlace<Algebraic>, 3> corners;
};
std::vector<ChildPiece> child_pieces(const std::vector<RegularPiece>& pieces, int dilation = 2);

/// Kinds of pieces without their polynomials.
std::vector<RegularPiece> squares();
std::vector<RegularPiece> triangles();

/// Squares, triangles, or squares in four triangles, of the least degree up to `most`; nothing where none passes.
std::optional<RegularPieces> regular_pieces(const RegularMask<Algebraic>& mask, int most = 6);

}  // namespace sublimit
