// SPDX-License-Identifier: Apache-2.0
#pragma once
// Polynomials on a piece, with coefficients over the points that the piece depends on.
#include <Eigen/Core>

#include <vector>

#include "sublimit/neighborhood/piece_map.h"

namespace sublimit {

using RowMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Products of Chebyshev polynomials T_i(2u - 1) T_j(2v - 1) and their derivatives.
class PolynomialBasis {
 public:
  PolynomialBasis() = default;
  /// @param total  i + j <= degree (triangles), else i, j <= degree
  PolynomialBasis(int degree, bool total) : degree_(degree), total_(total) {}
  int degree() const { return degree_; }
  bool total() const { return total_; }
  int size() const { return total_ ? (degree_ + 1) * (degree_ + 2) / 2 : (degree_ + 1) * (degree_ + 1); }
  /// Returns values and derivatives up to `order` at (u, v): rows value; u, v; uu, uv, vv; columns by i, then
  /// j.
  RowMatrix at(double u, double v, int order) const;

 private:
  int degree_ = 0;
  bool total_ = false;
};

/// The limit of a piece as a polynomial in its parameters.
struct PiecePolynomial {
  PolynomialBasis basis;
  /// Coefficients over differences of points (PieceBlock), #basis x (#slots - 1). A piece cut along u = v has
  /// two: for u >= v, and for u < v.
  std::vector<RowMatrix> coefficients;

  /// Returns rows over differences: position minus slot 0, then derivatives up to `order`.
  RowMatrix rows(const PieceCoordinates& place, int order) const {
    const bool second = coefficients.size() > 1 && place.u < place.v;
    return basis.at(place.u, place.v, order) * coefficients[second ? 1 : 0];
  }
};

}  // namespace sublimit
