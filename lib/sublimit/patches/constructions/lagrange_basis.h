// SPDX-License-Identifier: Apache-2.0
#pragma once
// Lagrange polynomials in barycentric form: l_i(x) = (w_i / (x - x_i)) / sum_j w_j / (x - x_j), w_i = 1 / prod
// (x_i - x_j). Rows of the r-th derivative are l(x) D^r, where D is the matrix of derivatives at the nodes.
// Source: Berrut, Trefethen 2004, "Barycentric Lagrange interpolation".
#include <span>
#include <vector>

#include "sublimit/source/rational.h"

namespace sublimit {

/// Degree above which interpolation at equidistant nodes is ill-conditioned: errors of the points are amplified
/// between them (Lebesgue constant 29 at degree 10, 11000 at degree 20).
inline constexpr int wild_lagrange_degree = 10;

/// The Lagrange basis of some nodes.
class LagrangeBasis {
 public:
  /// @param nodes  in any order; the domain is from the least to the greatest
  /// @throws InvalidParameter  fewer than 2 nodes, nodes that are not finite or equal (names their indices), or
  ///                           so uneven that weights overflow
  explicit LagrangeBasis(std::vector<double> nodes);

  Index size() const { return static_cast<Index>(nodes_.size()); }
  double begin() const { return begin_; }
  double end() const { return begin_ + length_; }
  double length() const { return length_; }
  /// Returns the nodes scaled to [0, 1].
  std::span<const double> nodes() const { return nodes_; }

  /// Returns the rows of position and derivatives per unit of u. At a node the position is exactly its point.
  /// @param u  0 to 1
  WeightRows rows(double u, int order) const;
  /// Returns u of a parameter; for a node exactly the value in `nodes`.
  double unit(double t) const { return (t - begin_) / length_; }
  /// Throws unless a parameter is in the domain.
  /// @throws InvalidParameter  it is outside
  void check_inside(double t) const;

 private:
  double begin_ = 0, length_ = 1;
  std::vector<double> nodes_, weights_;
  Eigen::MatrixXd D_;
};

}  // namespace sublimit
