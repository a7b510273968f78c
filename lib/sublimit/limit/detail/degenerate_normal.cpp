// SPDX-License-Identifier: Apache-2.0
#include "sublimit/limit/detail/degenerate_normal.h"

#include <Eigen/Geometry>

#include "sublimit/core/detail/dense_decompositions.h"

namespace sublimit {

using Eigen::Vector3d;

Vector3d degenerate_normal(const Vector3d& t1, const Vector3d& t2, const std::vector<Vector3d>& higher, double scale,
                           const Vector3d& turn_area) {
  Eigen::MatrixXd tangents(2, 3);
  tangents << t1.transpose(), t2.transpose();
  const SingularValues lines = singular_values(tangents);
  const bool has_direction = lines.values[0] > 1e-9 * scale;
  const Vector3d direction = has_direction ? Vector3d(lines.right.col(0)) : Vector3d::Zero();
  Eigen::MatrixXd rest(higher.size(), 3);
  for (size_t i = 0; i < higher.size(); ++i)
    rest.row(Eigen::Index(i)) = higher[i] - direction * direction.dot(higher[i]);
  if (higher.empty()) return Vector3d::Zero();
  const SingularValues span = singular_values(rest);
  const auto sigma = [&](Eigen::Index i) { return i < span.values.size() ? span.values[i] : 0.0; };
  const Eigen::Index needed = has_direction ? 1 : 2;
  if (sigma(needed - 1) <= 1e-9 * scale || sigma(needed) > 1e-6 * sigma(needed - 1)) return Vector3d::Zero();
  Vector3d normal = has_direction ? direction.cross(Vector3d(span.right.col(0)))
                                  : Vector3d(span.right.col(0)).cross(Vector3d(span.right.col(1)));
  normal.normalize();
  const double turn = normal.dot(turn_area);
  if (std::abs(turn) <= 1e-9 * scale * scale) return Vector3d::Zero();
  return turn > 0 ? normal : -normal;
}

}  // namespace sublimit
