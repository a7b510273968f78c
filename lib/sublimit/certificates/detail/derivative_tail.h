// SPDX-License-Identifier: Apache-2.0
#pragma once
// How far the derivatives of a limit can be from the differences of its control points, for schemes that are not
// polynomials. Second differences d follow a scheme of their own,
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

#include "sublimit/certificates/detail/regular_pieces.h"

namespace sublimit {

/// A second difference at a point: of family `family` there.
struct SecondDifference {
  size_t family;
  LatticePoint at;
  auto operator<=>(const SecondDifference&) const = default;
};

struct DerivativeTail {
  struct Family {
    LatticePoint e, f;  ///< d(P) = c(P+e+f) - c(P+e) - c(P+f) + c(P)
    std::map<LatticePoint, Algebraic> mask;
  };
  std::vector<Family> families;
  int steps = 0;     ///< L
  Ball contraction;  ///< D^L * norm, below 1
  /// Kinds of pieces, with the points that they and all their descendants depend on as controls; no functions.
  RegularPieces pieces;
  std::vector<std::vector<SecondDifference>> around;  ///< by piece: those that bound its tail
  std::vector<std::array<LatticePoint, 2>> bases;     ///< by piece: edges from there along e1 and along e2 are its own
  std::array<Ball, 2> factor;                         ///< for the derivatives along e1 and e2
};

/// @return  nothing where the mask does not divide, is dual, or no norm up to `most` steps is small enough
std::optional<DerivativeTail> derivative_tail(const RegularMask<Algebraic>& mask, int most = 6);

}  // namespace sublimit
