// SPDX-License-Identifier: Apache-2.0
#pragma once
// A limit surface with its points, cut into cells that are almost flat, each in boxes that hold it: what
// searches in space need.
#include <vector>

#include "sublimit/limit/limit_surface.h"

namespace sublimit {

struct LimitCell {
  Sample start;  ///< a place in it or, of slivers, close to it
  /// All of it is about as near to its start in u and v.
  double radius = 0;
  Eigen::AlignedBox3d box;  ///< along the axes
  /// The same along directions of its own: rows of a rotation, the last one near the normal; in these coordinates.
  Eigen::Matrix3d frame;
  Eigen::AlignedBox3d own_box;

  /// Square of the distance of a point from both boxes, at most that from the cell.
  double squared_distance(const Eigen::Vector3d& point) const;
};

/// Cells of all of the surface but its holes, in the order of addresses.
/// Polynomial pieces are cut until they are thin, and boxes hold their Bernstein coefficients; near extraordinary
/// vertices pieces are cut into children, and boxes hold all points that these depend on. Where no piece is a
/// polynomial that would be much too wide: there boxes hold a net of limit points, widened by a quarter.
/// @param points  of the level, #V x 3
/// @throws InvalidParameter  points that do not fit
std::vector<LimitCell> limit_cells(const LimitSurface& surface, const Points& points);

}  // namespace sublimit
