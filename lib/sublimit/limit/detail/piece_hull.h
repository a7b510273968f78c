// SPDX-License-Identifier: Apache-2.0
#pragma once
// What holds a piece of the limit: a polynomial lies in the hull of its Bernstein coefficients; any other piece in the
// hull of the points that it depends on, if no weight is negative. Where some are, a place has its weights' absolute
// sum, at most `PieceType::reach` times the points' distance from one of them.
#include <array>

#include "sublimit/neighborhood/piece_types.h"

namespace sublimit {

/// Bernstein coefficients on the square or the triangle, by i, then j, by those of the basis.
Eigen::MatrixXd bernstein_from(const PolynomialBasis& basis);

/// Bernstein coefficients on the quarters of the square or triangle, by those on the whole; whatever the basis was.
class BernsteinQuarters {
 public:
  BernsteinQuarters(int degree, bool total);
  const Eigen::MatrixXd& quarter(int k) const { return quarters_[size_t(k)]; }
  /// The place in a quarter of a place in the whole; outside of [0, 1] it is in another one.
  static Eigen::Vector2d in_quarter(int k, bool triangle, double u, double v);

 private:
  std::array<Eigen::MatrixXd, 4> quarters_;
};

/// Bernstein nets of a piece: quarters as `BernsteinQuarters` makes them, and coefficients from those of the basis.
class BernsteinNets : public BernsteinQuarters {
 public:
  explicit BernsteinNets(const PolynomialBasis& basis)
      : BernsteinQuarters(basis.degree(), basis.total()), from_basis_(bernstein_from(basis)) {}
  const Eigen::MatrixXd& from_basis() const { return from_basis_; }

 private:
  Eigen::MatrixXd from_basis_;
};

/// Points of a child of a piece.
Points child_points(const PieceLink& link, const Points& points);

}  // namespace sublimit
