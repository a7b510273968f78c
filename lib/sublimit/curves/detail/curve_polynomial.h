// SPDX-License-Identifier: Apache-2.0
#pragma once
// Rows of weights that are polynomials of the place: found from values at equal distances, kept as Bernstein
// polynomials.
#include <Eigen/Core>

#include <array>
#include <optional>
#include <vector>

#include "sublimit/core/types.h"

namespace sublimit {

/// Rows of the position, of its first and of its second differences, times d and d (d - 1).
struct CurvePolynomial {
  using Real = long double;  // for what is made once and used often
  using Row = Eigen::Matrix<Real, 1, Eigen::Dynamic>;
  using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

  int degree = 0;
  std::array<Matrix, 3> coefficients;

  /// Rows at y in [0, 1], `width` weights each: the position, then derivatives by y.
  void evaluate(double y, int derivatives, Index width, double* weights) const;
};

/// The polynomial through values at equal distances, if there is one.
/// @param values   rows from y = 0 to y = 1
/// @param highest  degree that is tried; none above 20
std::optional<CurvePolynomial> polynomial_through(const std::vector<CurvePolynomial::Row>& values, int highest);

}  // namespace sublimit
