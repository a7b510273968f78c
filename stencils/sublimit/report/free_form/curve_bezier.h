// SPDX-License-Identifier: Apache-2.0
#pragma once
// A free-form curve of a file as Bezier pieces, one for each span of its knots, in doubles and in exact ratios.
#include <algorithm>
#include <vector>

#include "sublimit/certificates/numbers/detail/rational_number.h"
#include "sublimit/io/free_form.h"
#include "sublimit/patches/joins/seam_strips.h"

namespace sublimit {

struct CurveBezier {
  std::vector<BezierPiece<double>> pieces;  ///< at least one
  std::vector<double> breaks;               ///< parameters of the ends of pieces, one more than pieces
  /// Pieces computed without rounding from the doubles in the file; empty for bases other than Bezier and
  /// B-spline.
  std::vector<BezierPiece<Rational>> exact;
};

/// Returns the Bezier pieces of a curve.
/// @throws InvalidParameter  knots that do not make a B-spline
CurveBezier curve_bezier(const FreeForm& shapes, const FreeFormCurve& curve);

/// Returns the Bezier pieces of a part of a spline curve's domain.
/// @param columns   3 numbers for each control point, or 4 if the curve is rational
/// @param ends      set to the parameters of the ends of pieces
template <class T>
std::vector<BezierPiece<T>> bezier_pieces_of(const Knots<T>& knots, const std::vector<T>& columns, bool rational,
                                             const T& first, const T& last, std::vector<T>& ends) {
  const int p = knots.degree(), width = rational ? 4 : 3;
  std::vector<BezierPiece<T>> pieces;
  for (Index face = 0; face < knots.num_faces(); ++face) {
    const Index span = knots.span(face);
    const T from = std::max(knots.all()[size_t(span)], first), to = std::min(knots.all()[size_t(span) + 1], last);
    if (!(from < to)) continue;
    BezierPiece<T> piece{.degree = p, .columns = {}, .coordinates = Coordinates::plain, .length = T(to - from)};
    if (rational) piece.coordinates = Coordinates::homogeneous;
    const std::vector<T> rows = part_rows(knots, LinePart<T>{face, from, to});
    for (int i = 0; i <= p; ++i)
      for (int k = 0; k < width; ++k) {
        T sum(0);
        for (int m = 0; m <= p; ++m)
          sum += rows[size_t(i * (p + 1) + m)] * columns[size_t(knots.point(span - p + m) * width + k)];
        piece.columns.push_back(sum);
      }
    pieces.push_back(std::move(piece));
    ends.push_back(to);
  }
  return pieces;
}

/// Returns a piece in the opposite direction.
template <class T>
BezierPiece<T> reversed(const BezierPiece<T>& piece) {
  BezierPiece<T> result = piece;
  const size_t points = static_cast<size_t>(piece.degree) + 1, width = piece.columns.size() / points;
  for (size_t i = 0; i < points; ++i)
    for (size_t k = 0; k < width; ++k) result.columns[i * width + k] = piece.columns[(points - 1 - i) * width + k];
  return result;
}

}  // namespace sublimit
