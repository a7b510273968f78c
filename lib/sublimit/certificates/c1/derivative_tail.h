// SPDX-License-Identifier: Apache-2.0
#pragma once
// Bounds of the difference between derivatives of a limit and differences of its control points, for schemes
// without polynomials. Second differences d follow a scheme of their own,
//
//   d'(P) = sum over Q of b(P - D Q) d(Q),     mask(z) = sum over 0 <= i, j < D of b(z + i e + j f),
//
// one for each pair of directions e, f by which the mask divides (D: dilation). If D^L times its norm over L steps is
// smaller than 1, first differences times D^k converge to the derivatives: the limit is C^1 on regular meshes, and
//
//   |derivative - difference| <= factor * (largest second difference around)      anywhere on the piece.
//
// Sources: Dyn, Levin, "Subdivision schemes in geometric modelling", Acta Numerica 2002; Zorin 2000 for the use.
#include <optional>

#include "sublimit/certificates/c1/regular_pieces.h"

namespace sublimit {

/// A second difference of a family at a point.
struct SecondDifference {
  size_t family;
  LatticePoint at;
  auto operator<=>(const SecondDifference&) const = default;
};

/// The bound of a scheme.
struct DerivativeTail {
  /// Second differences along e and f, with the mask b of their scheme.
  struct Family {
    LatticePoint e, f;  ///< d(P) = c(P+e+f) - c(P+e) - c(P+f) + c(P)
    std::map<LatticePoint, Algebraic> mask;
  };
  std::vector<Family> families;
  int steps = 0;     ///< L
  Ball contraction;  ///< D^L * norm, below 1
  /// Kinds of pieces; `controls` are the points that a piece and all its descendants depend on; no functions.
  RegularPieces pieces;
  std::vector<std::vector<SecondDifference>> around;  ///< by piece: second differences that enter the bound
  std::vector<std::array<LatticePoint, 2>> bases;     ///< by piece: starts of its edges along e1 and along e2
  std::array<Ball, 2> factor;                         ///< factor of the bound for derivatives along e1 and e2
};

/// Returns the bound of a mask.
/// @param most  largest number of steps L to try
/// @return  nothing if the mask has no such factors, is dual, or no norm up to `most` steps is small enough
std::optional<DerivativeTail> derivative_tail(const RegularMask<Algebraic>& mask, int most = 6);

}  // namespace sublimit
