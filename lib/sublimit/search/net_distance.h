// SPDX-License-Identifier: Apache-2.0
#pragma once
// Bounds on the distance of a point from a polynomial part, by its Bernstein coefficients.
#include <array>

#include "sublimit/limit/net_derivatives.h"

namespace sublimit {

/// Half the square of the distance from q is convex on all of the part: its smallest value, and where.
struct ConvexMinimum {
  double lower = 0;            ///< of the distance
  double at = 0;               ///< the distance of the place
  std::array<double, 2> uv{};  ///< of the part
};

class NetDistance {
 public:
  /// @param rounding  of differences of coefficients and q
  NetDistance(const PolynomialBasis& basis, const Points& net, const Eigen::Vector3d& query, double rounding);
  /// Of the hull from q.
  /// @param towards  a unit vector: the bound is close if it points from q to the nearest place
  double lower(const Eigen::Vector3d& towards) const;
  /// Nothing where intervals do not show that there is one minimum.
  std::optional<ConvexMinimum> convex_minimum() const;

 private:
  const PolynomialBasis& basis_;
  Points net_;  // less q
  double rounding_;
};

}  // namespace sublimit
