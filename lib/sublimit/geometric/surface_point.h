// SPDX-License-Identifier: Apache-2.0
#pragma once
// A point of a surface with everything of second order: normal, principal curvatures and directions.
#include <Eigen/Core>

namespace sublimit {

struct SurfacePoint {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();      ///< of length 1
  double k1 = 0, k2 = 0;                                  ///< in any order; k > 0 where the surface bends to the normal
  Eigen::Vector3d direction1 = Eigen::Vector3d::UnitX();  ///< of k1, of length 1, in the tangent plane

  Eigen::Vector3d direction2() const;  ///< normal x direction1
  /// The second fundamental form on vectors of space: k1 d1 d1^T + k2 d2 d2^T. It does not depend on signs and order
  /// of the directions, nor, where k1 = k2, on the directions at all.
  Eigen::Matrix3d shape() const;
  /// Returns the point with the opposite normal.
  SurfacePoint flipped() const { return {position, -normal, -k1, -k2, direction1}; }
};

/// The point whose second fundamental form is `shape` restricted to the plane at right angles to `normal` (of length
/// 1); k1 >= k2.
SurfacePoint surface_point(const Eigen::Vector3d& position, const Eigen::Vector3d& normal,
                           const Eigen::Matrix3d& shape);

}  // namespace sublimit
