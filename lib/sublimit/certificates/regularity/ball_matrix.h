// SPDX-License-Identifier: Apache-2.0
#pragma once
// Matrices that are certainly near a matrix of doubles: midpoint and radius, entry by entry. Products are those of
// doubles, with rounding accounted for a priori (Rump 1999, "Fast and parallel interval arithmetic", BIT 39).
#include <Eigen/Core>

#include <optional>

#include "sublimit/certificates/regularity/interval.h"
#include "sublimit/certificates/regularity/rational.h"

namespace sublimit {

struct BallMatrix {
  Eigen::MatrixXd middle, radius;

  BallMatrix() = default;
  /// Exactly these doubles.
  explicit BallMatrix(const Eigen::MatrixXd& exact)
      : middle(exact), radius(Eigen::MatrixXd::Zero(exact.rows(), exact.cols())) {}
  /// Encloses a matrix of ratios.
  explicit BallMatrix(const Eigen::Matrix<Rational, Eigen::Dynamic, Eigen::Dynamic>& exact);

  Eigen::Index rows() const { return middle.rows(); }
};

/// Encloses all products of members.
BallMatrix operator*(const BallMatrix& a, const BallMatrix& b);
BallMatrix operator-(const BallMatrix& a, const BallMatrix& b);
/// Exactly: the factor is a power of two and nothing underflows that matters.
BallMatrix scaled(const BallMatrix& a, double power_of_two);

BallMatrix transposed(const BallMatrix& a);

/// Encloses G^-1 A G; nothing where G is not certainly regular.
std::optional<BallMatrix> similar_matrix(const BallMatrix& A, const Eigen::MatrixXd& G);

/// Certain bounds of the maximum norm (largest row sum of moduli) of all members.
Interval maximum_norm(const BallMatrix& a);
Interval trace(const BallMatrix& a);

/// Certain bounds of the spectral radius of all members, from norms and traces of their powers 2^k: |tr P| <= n r(P).
Interval spectral_radius(BallMatrix a);

}  // namespace sublimit
