// SPDX-License-Identifier: Apache-2.0
#pragma once
// Lagrange's polynomials in barycentric form: l_i(x) = (w_i / (x - x_i)) / sum_j w_j / (x - x_j), w_i = 1 / prod (x_i -
// x_j). Derivatives are values of polynomials too: rows of the r-th are l(x) D^r, D the derivatives at the nodes.
// Source: Berrut, Trefethen 2004, "Barycentric Lagrange interpolation".
#include <span>
#include <vector>

#include "sublimit/patches/rational.h"

namespace sublimit {

/// Degrees above this one on equal distances: small errors of the points become large between them (Lebesgue constants
/// 29 at 10, 11000 at 20).
inline constexpr int wild_lagrange_degree = 10;

class LagrangeBasis {
 public:
  /// @param nodes  in any order; the domain is from the least to the greatest
  /// @throws InvalidParameter  fewer than 2, not finite, equal ones, by their numbers, or so uneven that weights leave
  ///                           the range of numbers
  explicit LagrangeBasis(std::vector<double> nodes);

  Index size() const { return static_cast<Index>(nodes_.size()); }
  double begin() const { return begin_; }
  double end() const { return begin_ + length_; }
  double length() const { return length_; }
  /// Nodes from 0 to 1.
  std::span<const double> nodes() const { return nodes_; }

  /// Position and derivatives per unit of u; at a node exactly its point.
  /// @param u  0 to 1
  WeightRows rows(double u, int order) const;
  /// u of a parameter; a node's is that of `nodes`.
  double unit(double t) const { return (t - begin_) / length_; }
  /// @throws InvalidParameter  outside the domain
  void check_inside(double t) const;

 private:
  double begin_ = 0, length_ = 1;
  std::vector<double> nodes_, weights_;
  Eigen::MatrixXd D_;
};

}  // namespace sublimit
