// SPDX-License-Identifier: Apache-2.0
#pragma once
// Bounds on the distance of a point from a polynomial or rational part, by its Bernstein coefficients.
//
// For a rational part x = X / w let h = (|X - w q|^2 - d^2 w^2) / 2, a polynomial. If h >= 0, no point is
// nearer to q than d. For polynomial parts, with w = 1 and d = 0, h is half of |x - q|^2.
#include <array>

#include "sublimit/nets/net_derivatives.h"

namespace sublimit {

/// Minimum of h on a part on which h is convex.
struct ConvexMinimum {
  double lower = 0;            ///< proved lower bound of the distance
  double at = 0;               ///< distance of the place of the minimum
  std::array<double, 2> uv{};  ///< parameters of this place in the part
};

/// A part relative to a point q.
class NetDistance {
 public:
  /// @param basis     must outlive this
  /// @param net       a net of a `PiecePart`
  /// @param query     the point q
  /// @param rounding  bound of rounding errors in differences of points and q
  NetDistance(const PolynomialBasis& basis, const Points& net, const Eigen::Vector3d& query, double rounding);
  NetDistance(const PolynomialBasis&&, const Points&, const Eigen::Vector3d&, double) = delete;
  /// Returns a lower bound on the distance of the hull from q.
  /// @param towards  a unit vector; the bound is tight if it points from q to the nearest place
  double lower(const Eigen::Vector3d& towards) const;
  /// Returns the minimum of h; nothing unless intervals prove that h is convex.
  /// @param distance  for rational parts: the d above
  std::optional<ConvexMinimum> convex_minimum(double distance) const;

 private:
  bool is_rational() const { return net_.cols() == 4; }

  const PolynomialBasis& basis_;
  Points net_;  // X - w q, and for rational parts w
  double rounding_;
};

}  // namespace sublimit
