// SPDX-License-Identifier: Apache-2.0
#pragma once
// Rows of weights that are polynomials in the parameter: interpolated from values at equidistant parameters,
// stored as Bernstein coefficients.
#include <Eigen/Core>

#include <array>
#include <optional>
#include <vector>

#include "sublimit/core/types.h"

namespace sublimit {

/// Polynomial of degree d with rows of weights as Bernstein coefficients: those of the position, and of its
/// first and second derivatives (differences times d and d (d - 1)).
struct CurvePolynomial {
  using Real = long double;  // for the construction; results are rounded to double
  using Row = Eigen::Matrix<Real, 1, Eigen::Dynamic>;
  using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

  int degree = 0;
  std::array<Matrix, 3> coefficients;

  /// Computes the rows at y in [0, 1].
  /// @param derivatives  highest derivative by y: 0, 1 or 2
  /// @param weights      result: `derivatives` + 1 rows of `width` weights, position first
  void evaluate(double y, int derivatives, Index width, double* weights) const;
};

/// Returns the polynomial through values at equidistant parameters; nothing if no degree fits all of them up to
/// rounding (16 eps).
/// @param values   rows from y = 0 to y = 1
/// @param highest  highest degree to try; at most 20
std::optional<CurvePolynomial> polynomial_through(const std::vector<CurvePolynomial::Row>& values, int highest);

}  // namespace sublimit
