// SPDX-License-Identifier: Apache-2.0
#pragma once
// Points of surfaces with second order data: normal, principal curvatures and directions.
#include <Eigen/Core>

namespace sublimit {

/// A point with second order data.
struct SurfacePoint {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  ///< unit length
  double k1 = 0, k2 = 0;                              ///< in any order; k > 0 if the surface curves towards the normal
  Eigen::Vector3d direction1 = Eigen::Vector3d::UnitX();  ///< direction of k1: unit length, in the tangent plane

  Eigen::Vector3d direction2() const;  ///< normal x direction1
  /// Returns the second fundamental form on vectors in space: k1 d1 d1^T + k2 d2 d2^T. It does not depend on
  /// signs and order of the directions, nor on the directions at all if k1 = k2.
  Eigen::Matrix3d shape() const;
  /// Returns the point with the opposite normal.
  SurfacePoint flipped() const { return {position, -normal, -k1, -k2, direction1}; }
};

/// Returns the point whose second fundamental form is `shape` restricted to the plane perpendicular to the unit
/// vector `normal`; k1 >= k2.
SurfacePoint surface_point(const Eigen::Vector3d& position, const Eigen::Vector3d& normal,
                           const Eigen::Matrix3d& shape);

}  // namespace sublimit
