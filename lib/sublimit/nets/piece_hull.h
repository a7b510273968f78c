// SPDX-License-Identifier: Apache-2.0
#pragma once
// Bounds of a piece of the limit. A polynomial lies in the convex hull of its Bernstein coefficients; any other
// piece in the hull of the points that it depends on, if no weight is negative. With negative weights it can
// leave their extent, by an estimated `PieceType::reach` times its size.
#include <array>
#include <vector>

#include "sublimit/neighborhood/piece_types.h"

namespace sublimit {

/// Returns the matrix that takes coefficients in a basis to Bernstein coefficients on the square or triangle,
/// by i, then j.
Eigen::MatrixXd bernstein_from(const PolynomialBasis& basis);

/// Matrices that take Bernstein coefficients on the square or triangle to those on its quarters. Quarter k is
/// the one at (k % 2, k / 2); quarter 3 of a triangle is the middle one, rotated by 180 degrees.
class BernsteinQuarters {
 public:
  BernsteinQuarters(int degree, bool total);
  const Eigen::MatrixXd& quarter(int k) const { return quarters_[size_t(k)]; }
  /// Returns the coordinates in a quarter of a place in the whole. They are outside [0, 1] if it is in another
  /// quarter.
  static Eigen::Vector2d in_quarter(int k, bool triangle, double u, double v);

 private:
  std::array<Eigen::MatrixXd, 4> quarters_;
};

/// Matrices for the Bernstein nets of a piece: from coefficients in its basis, and from the whole to quarters.
class BernsteinNets : public BernsteinQuarters {
 public:
  explicit BernsteinNets(const PolynomialBasis& basis)
      : BernsteinQuarters(basis.degree(), basis.total()), from_basis_(bernstein_from(basis)) {}
  const Eigen::MatrixXd& from_basis() const { return from_basis_; }

 private:
  Eigen::MatrixXd from_basis_;
};

/// Returns the Bernstein coefficients of the polynomials of a piece, a net each.
/// @param from_basis  `bernstein_from` their basis
/// @param points      points of the piece, by slot
std::vector<Points> polynomial_nets(const PiecePolynomial& polynomial, const Eigen::MatrixXd& from_basis,
                                    const Points& points);

/// Returns the points of a child of a piece, by slot, from those of the piece.
Points child_points(const PieceLink& link, const Points& points);

}  // namespace sublimit
