// SPDX-License-Identifier: Apache-2.0
#pragma once
// Bounds on the distance of a point from a polynomial or rational part, by its Bernstein coefficients.
//
// Half of |x - q|^2 is (|X - w q|^2 / w^2) / 2 of a rational part x = X / w. Where h = (|X - w q|^2 - d^2 w^2) / 2, a
// polynomial, is not below 0, no point is nearer than d; so both are the same quadratic form of coefficients, d = 0 and
// w = 1 of polynomials.
#include <array>

#include "sublimit/nets/net_derivatives.h"

namespace sublimit {

/// h is convex on all of the part: what its smallest value proves, and where it is.
struct ConvexMinimum {
  double lower = 0;            ///< of the distance
  double at = 0;               ///< the distance of the place
  std::array<double, 2> uv{};  ///< of the part
};

class NetDistance {
 public:
  /// @param basis     which must stay
  /// @param net       as `PiecePart` has them
  /// @param rounding  of differences of points and q
  NetDistance(const PolynomialBasis& basis, const Points& net, const Eigen::Vector3d& query, double rounding);
  NetDistance(const PolynomialBasis&&, const Points&, const Eigen::Vector3d&, double) = delete;
  /// Returns a lower bound on the distance of the hull from q.
  /// @param towards  a unit vector: the bound is close if it points from q to the nearest place
  double lower(const Eigen::Vector3d& towards) const;
  /// Nothing where intervals do not show that there is one minimum.
  /// @param distance  of a rational part: the d above, which is to be proved
  std::optional<ConvexMinimum> convex_minimum(double distance) const;

 private:
  bool is_rational() const { return net_.cols() == 4; }

  const PolynomialBasis& basis_;
  Points net_;  // X - w q, and w of rational ones
  double rounding_;
};

}  // namespace sublimit
