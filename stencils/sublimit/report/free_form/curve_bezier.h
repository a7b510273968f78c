// SPDX-License-Identifier: Apache-2.0
#pragma once
// A free-form curve of a file as its Bezier pieces, one for each span of its knots, in doubles and in ratios.
#include <vector>

#include "sublimit/certificates/regularity/rational.h"
#include "sublimit/io/free_form.h"
#include "sublimit/patches/joins/bezier_piece.h"

namespace sublimit {

struct CurveBezier {
  std::vector<BezierPiece<double>> pieces;  ///< at least one
  std::vector<double> breaks;               ///< parameters of their ends, one more
  /// The same without rounding, of exactly the file's doubles; empty of other bases than Bezier and B-spline, whose
  /// pieces are computed.
  std::vector<BezierPiece<Rational>> exact;
};

/// @throws InvalidParameter  knots that make no B-spline
CurveBezier curve_bezier(const FreeForm& shapes, const FreeFormCurve& curve);

/// The same piece, run through backwards.
template <class T>
BezierPiece<T> reversed(const BezierPiece<T>& piece) {
  BezierPiece<T> result = piece;
  const size_t points = static_cast<size_t>(piece.degree) + 1, width = piece.columns.size() / points;
  for (size_t i = 0; i < points; ++i)
    for (size_t k = 0; k < width; ++k) result.columns[i * width + k] = piece.columns[(points - 1 - i) * width + k];
  return result;
}

}  // namespace sublimit
