// SPDX-License-Identifier: Apache-2.0
#pragma once
// A planar polygon with limit masks over its corners: one face of a dual control mesh.
#include <Eigen/Core>

namespace sublimit {

/// A polygon with limit masks.
struct PlanePolygon {
  Eigen::MatrixX3d corners;
  Eigen::MatrixX3d weights;  ///< row per corner: weights of the limit position (sum 1) and of both tangents (sum 0)
};

/// Result of orienting a polygon to a normal.
enum class OrientationResult {
  plain,       ///< rotated by at most a right angle
  over,        ///< rotated by more: its normal was opposite to the given one
  rebuilt,     ///< it had no tangent plane, and was replaced by a regular polygon
  impossible,  ///< it is a point, and was not changed
};

/// Projects the polygon onto its tangent plane, rotates it by the least angle such that tangent 1 x tangent 2
/// is along the normal, then scales it by `scale`. Keeps the limit position.
/// @param normal  any length > 0
OrientationResult turn_across(PlanePolygon& polygon, const Eigen::Vector3d& normal, double scale = 1);

/// Translates the polygon such that its limit position is a given point.
void move_to(PlanePolygon& polygon, const Eigen::Vector3d& position);

}  // namespace sublimit
