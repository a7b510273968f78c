// SPDX-License-Identifier: Apache-2.0
#pragma once
// Bounding boxes of a part of a surface, for searches in space.
#include <Eigen/Geometry>

#include <span>
#include <vector>

#include "sublimit/source/address.h"

namespace sublimit {

/// A part of a surface, bounded by two boxes.
struct LimitCell {
  Place start;  ///< a place in the cell, or close to it if the cell is a sliver
  /// Estimated largest distance of the cell's places from `start`, in u and in v.
  double radius = 0;
  Eigen::AlignedBox3d box;  ///< axis-aligned box
  Eigen::Matrix3d frame;    ///< rotation to the coordinates of `own_box`; the last row is near the normal
  Eigen::AlignedBox3d own_box;

  /// Returns a lower bound of the squared distance of a point from the cell: the larger one of those from both
  /// boxes.
  double squared_distance(const Eigen::Vector3d& point) const;
  /// Returns true if `own_box` is thin (height at most 3% of its longest side). Such a cell is not subdivided,
  /// unless it has folds (`turns`).
  bool is_thin() const;
};

/// Points whose convex hull contains a part of a surface.
using Hull = std::vector<Eigen::Vector3d>;

/// Returns the cell with boxes around a hull.
/// @param hull      not empty
/// @param margin    widens each box on all sides, by this multiple of its size in the same direction
/// @param of_width  widens each box on all sides, by this multiple of its largest size
LimitCell hull_cell(const Hull& hull, const Place& start, double radius, double margin = 0, double of_width = 0);

/// Returns true if normals of Bernstein nets differ much from their mean (cosine below 0.8), as at folds.
/// @param nets  nets of the same degree in both directions, or of one total degree if `triangle`
bool turns(std::span<const Points> nets, bool triangle);

}  // namespace sublimit
