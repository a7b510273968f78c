// SPDX-License-Identifier: Apache-2.0
#pragma once
// A part of a surface as a ray sees it: a map to the plane across the ray, whose zeros are hits.
#include <Eigen/Dense>

#include "sublimit/limit/piece_parts.h"

namespace sublimit {

/// How far outside of a part a zero may be for the neighbour to have it.
inline constexpr double beyond_part = 1e-9;

/// A ray as an origin and three axes, the last one along it.
struct RayFrame {
  Eigen::Vector3d origin;
  Eigen::Matrix3d axes;  ///< rows
  double length = 1;     ///< of the direction
  RayFrame(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction);
  /// Of a net as parts have them.
  Points seen(const Points& net) const;
};

class SeenNet {
 public:
  /// @param basis  which must stay
  /// @param net    seen along a ray
  SeenNet(const PolynomialBasis& basis, Points net) : basis_(basis), net_(std::move(net)) {}
  SeenNet(const PolynomialBasis&&, Points) = delete;

  /// No line through the ray has all of it on one side.
  /// @param slack  how far off counts as a hit
  bool can_be_hit(double slack) const;

  struct Zero {
    enum class Kind { none, one, unknown } kind;
    Eigen::Vector2d uv = Eigen::Vector2d::Zero();
    double s = 0;      ///< distance along the ray
    double reach = 0;  ///< how far off that may be
  };
  /// Of the part of a convex domain, the square or the triangle: where it is hit, if that is one place at most.
  /// @param slack  how far off counts as a hit
  Zero zero(double slack) const;

 private:
  bool is_rational() const { return net_.cols() == 4; }
  Eigen::Vector2d nearest_inside(const Eigen::Vector2d& p) const;

  const PolynomialBasis& basis_;
  Points net_;
};

}  // namespace sublimit
