// SPDX-License-Identifier: Apache-2.0
#pragma once
// Bezier curves and patches with control columns in any number type, and their derivatives across an end. Those
// of a patch are polynomials in the other parameter.
#include <cstddef>
#include <vector>

#include "sublimit/patches/detail/spline_rows.h"
#include "sublimit/patches/joins/line_polynomial.h"
#include "sublimit/source/rational.h"

namespace sublimit {

/// A Bezier curve.
template <class T>
struct BezierPiece {
  int degree = 0;
  std::vector<T> columns{};  ///< columns of the degree + 1 control points, point by point
  Coordinates coordinates = Coordinates::plain;
  T length = T(1);  ///< length of the parameter interval
};

/// A Bezier patch at an edge; u is the parameter across the edge, v the one along it.
template <class T>
struct BezierPatch {
  int degree_u = 0, degree_v = 0;
  std::vector<T> columns{};  ///< (degree_u + 1) x (degree_v + 1) control points, u fastest, of 3 or 4 columns each
  Coordinates coordinates = Coordinates::plain;
  T length = T(1);  ///< length of the parameter interval in u
};

namespace bezier_piece_detail {

[[noreturn]] void refuse_column_count(const char* which, std::size_t numbers, std::size_t points, int width);
[[noreturn]] void refuse_column(const char* which, std::size_t point, double value);
[[noreturn]] void refuse_length(const char* which, double length);
[[noreturn]] void refuse_dimensions(int left, int right);

template <class T>
bool is_finite(const T& x) {
  return x - x == T(0);
}

/// Throws unless the columns and length of a piece are valid.
/// @param width  required number of columns of a control point; 0: any
/// @return  the number of columns of a control point
/// @throws InvalidParameter  wrong counts, or numbers that are not finite; names the piece
template <class T>
int check_columns(const char* which, const std::vector<T>& columns, std::size_t points, int width, bool homogeneous,
                  const T& length) {
  const auto found = static_cast<int>(columns.size() / points);
  if (columns.size() % points != 0 || found < (homogeneous ? 2 : 1) || (width > 0 && found != width))
    refuse_column_count(which, columns.size(), points, width);
  for (std::size_t i = 0; i < columns.size(); ++i)
    if (!is_finite(columns[i])) refuse_column(which, i / found, static_cast<double>(columns[i]));
  if (!is_finite(length) || !(T(0) < length)) refuse_length(which, static_cast<double>(length));
  return found;
}

/// Returns the rows at an end of a Bezier curve: position, then derivatives per unit of its parameter.
template <class T>
std::vector<T> end_rows(int degree, bool at_end, int orders, const T& length) {
  std::vector<T> rows(static_cast<std::size_t>((orders + 1) * (degree + 1)));
  span_rows(bezier_knots<T>(degree), 0, T(at_end ? 1 : 0), orders, std::span<T>(rows));
  T unit(1);
  for (int r = 1; r <= orders; ++r) {
    unit *= length;
    for (int i = 0; i <= degree; ++i) rows[r * (degree + 1) + i] /= unit;
  }
  return rows;
}

}  // namespace bezier_piece_detail

/// Homogeneous coordinates x, y, z, w of the points of an edge, as polynomials along it; w = 1 for plain
/// columns.
template <class T>
using LineColumn = std::array<LinePolynomial<T>, 4>;

/// Returns the derivatives of a patch by u, per unit of its parameter, along u = 0 or u = 1.
/// @return  orders + 1 columns, the position first
template <class T>
std::vector<LineColumn<T>> cross_derivatives(const BezierPatch<T>& patch, bool at_end, int orders) {
  const int width = patch.coordinates == Coordinates::homogeneous ? 4 : 3, p = patch.degree_u, q = patch.degree_v;
  const std::vector<T> rows = bezier_piece_detail::end_rows(p, at_end, orders, patch.length);
  std::vector<LineColumn<T>> result;
  for (int r = 0; r <= orders; ++r) {
    LineColumn<T> column;
    for (int k = 0; k < width && r <= p; ++k) {
      std::vector<T> c(static_cast<std::size_t>(q) + 1, T(0));
      for (int j = 0; j <= q; ++j)
        for (int i = 0; i <= p; ++i)
          if (!(rows[r * (p + 1) + i] == T(0)))
            c[j] += rows[r * (p + 1) + i] * patch.columns[static_cast<std::size_t>((j * (p + 1) + i) * width + k)];
      column[static_cast<std::size_t>(k)] = LinePolynomial<T>(std::move(c));
    }
    if (width == 3 && r == 0) column[3] = LinePolynomial<T>({T(1)});
    result.push_back(std::move(column));
  }
  return result;
}

}  // namespace sublimit
