// SPDX-License-Identifier: Apache-2.0
#pragma once
// A piece without a polynomial as a ray sees it, by limits on a grid: how far it goes, and how its slopes vary, between
// them is estimated by second differences.
#include <algorithm>
#include <functional>

#include "sublimit/search/detail/piece_limits.h"
#include "sublimit/search/detail/seen_net.h"

namespace sublimit {

class SeenLimit {
 public:
  /// @param limits  seen along a ray, by the rows of the grid
  SeenLimit(const PieceGrid& grid, Points limits) : grid_(grid), limits_(std::move(limits)) {}

  /// True if the ray can meet the piece, according to the estimate.
  bool can_be_hit(double slack) const;
  /// @param at  exact limits at places of the piece, seen along the ray
  SeenZero zero(double slack, const std::function<Eigen::Vector3d(const Eigen::Vector2d&)>& at) const;
  /// How far across the ray the surface may be from the limits of the grid.
  double bend_across() const { return std::max(bend(limits_.col(0)), bend(limits_.col(1))); }

 private:
  /// The largest second difference, along the sides and across.
  double bend(const Eigen::VectorXd& values) const;

  PieceGrid grid_;
  Points limits_;
};

/// A box of limits, widened by what is estimated between them.
Eigen::AlignedBox3d estimated_box(const PieceGrid& grid, const Points& limits);

}  // namespace sublimit
