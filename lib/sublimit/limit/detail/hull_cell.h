// SPDX-License-Identifier: Apache-2.0
#pragma once
// A part of a surface in boxes that hold it, for searches in space.
#include <Eigen/Geometry>

#include <span>
#include <vector>

#include "sublimit/limit/address.h"

namespace sublimit {

struct LimitCell {
  Place start;  ///< a place in it or, of slivers, close to it
  /// All of it is about as near to its start in u and v.
  double radius = 0;
  Eigen::AlignedBox3d box;  ///< along the axes
  /// A second box along the rows of a rotation, the last one near the normal; in these coordinates.
  Eigen::Matrix3d frame;
  Eigen::AlignedBox3d own_box;

  /// Square of the distance of a point from both boxes, at most that from the cell.
  double squared_distance(const Eigen::Vector3d& point) const;
  /// Its own box is: where there are no folds such a cell is cut no further.
  bool is_thin() const;
};

using Hull = std::vector<Eigen::Vector3d>;

/// @param hull    not empty
/// @param margin, of_width  widen the box by parts of its own sizes, and of the largest one
LimitCell hull_cell(const Hull& hull, const Place& start, double radius, double margin = 0, double of_width = 0);

/// True if normals of the nets, Bernstein coefficients of one degree in both directions, differ much: there are folds.
bool turns(std::span<const Points> nets, bool triangle);

}  // namespace sublimit
