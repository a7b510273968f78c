// SPDX-License-Identifier: Apache-2.0
#pragma once
// A polygon laid into a plane: one face of a dual control mesh, with the limit's masks over its corners.
#include <Eigen/Core>

namespace sublimit {

struct PlanePolygon {
  Eigen::MatrixX3d corners;
  Eigen::MatrixX3d weights;  ///< by corner: of the limit position (sum 1), of both tangents (sum 0)
};

/// Result of orienting a polygon to a normal.
enum class OrientationResult {
  plain,
  over,        ///< its own normal opposes the given one
  rebuilt,     ///< it had no tangent plane: corners are those of a regular polygon now
  impossible,  ///< it is a point
};

/// Projects the polygon onto its own tangent plane and rotates that, by the least angle, so that tangent 1 x tangent 2
/// is along the normal; then scales it. The limit position stays.
/// @param normal  of any length > 0
OrientationResult turn_across(PlanePolygon& polygon, const Eigen::Vector3d& normal, double scale = 1);

/// Translates the polygon, so that its limit position is a given point.
void move_to(PlanePolygon& polygon, const Eigen::Vector3d& position);

}  // namespace sublimit
