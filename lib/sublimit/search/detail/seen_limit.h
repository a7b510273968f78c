// SPDX-License-Identifier: Apache-2.0
#pragma once
// Intersection of a ray with a piece without a polynomial, from limits on a grid. Extent and slopes between
// grid points are estimated from second differences.
#include <algorithm>
#include <functional>

#include "sublimit/search/detail/piece_limits.h"
#include "sublimit/search/detail/seen_net.h"

namespace sublimit {

/// A piece in the coordinates of a ray.
class SeenLimit {
 public:
  /// @param limits  limits at the grid points, in the coordinates of a ray (RayFrame)
  SeenLimit(const PieceGrid& grid, Points limits) : grid_(grid), limits_(std::move(limits)) {}

  /// True if the ray can meet the piece, according to the estimate.
  bool can_be_hit(double slack) const;
  /// Returns the place at which the ray meets the piece, if there is at most one.
  /// @param at  returns the exact limit at a place of the piece, in the coordinates of the ray
  SeenZero zero(double slack, const std::function<Eigen::Vector3d(const Eigen::Vector2d&)>& at) const;
  /// Returns the estimated distance, across the ray, of the surface from the limits of the grid.
  double bend_across() const { return std::max(bend(limits_.col(0)), bend(limits_.col(1))); }

 private:
  /// Returns the largest second difference, along the sides and mixed.
  double bend(const Eigen::VectorXd& values) const;

  PieceGrid grid_;
  Points limits_;
};

/// Returns the box of limits, enlarged by the estimated extent between them.
Eigen::AlignedBox3d estimated_box(const PieceGrid& grid, const Points& limits);

}  // namespace sublimit
