// SPDX-License-Identifier: Apache-2.0
#include "sublimit/geometric/surface_point.h"

#include <Eigen/Geometry>

#include <cmath>

namespace sublimit {

using Eigen::Matrix3d, Eigen::Vector3d;

Vector3d SurfacePoint::direction2() const { return normal.cross(direction1); }

Matrix3d SurfacePoint::shape() const {
  const Vector3d d2 = direction2();
  return k1 * direction1 * direction1.transpose() + k2 * d2 * d2.transpose();
}

SurfacePoint surface_point(const Vector3d& position, const Vector3d& normal, const Matrix3d& shape) {
  const Vector3d a = normal.unitOrthogonal(), b = normal.cross(a);
  const double aa = a.dot(shape * a), bb = b.dot(shape * b), ab = (a.dot(shape * b) + b.dot(shape * a)) / 2;
  // A rotation by half the angle diagonalises; hypot loses no digits where the curvatures are nearly equal.
  const double half_difference = (aa - bb) / 2, radius = std::hypot(half_difference, ab);
  const double angle = std::atan2(ab, half_difference) / 2;
  Vector3d direction = std::cos(angle) * a + std::sin(angle) * b;
  direction = (direction - direction.dot(normal) * normal).normalized();
  return {position, normal, (aa + bb) / 2 + radius, (aa + bb) / 2 - radius, direction};
}

}  // namespace sublimit
