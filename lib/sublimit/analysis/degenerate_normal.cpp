// SPDX-License-Identifier: Apache-2.0
#include "sublimit/analysis/degenerate_normal.h"

#include <Eigen/Geometry>
#include <Eigen/SVD>

namespace sublimit {

using Eigen::Vector3d;

Vector3d degenerate_normal(const Vector3d& t1, const Vector3d& t2, const std::vector<Vector3d>& higher, double scale,
                           const Vector3d& turn_area) {
  Eigen::MatrixXd tangents(3, 2);
  tangents << t1, t2;
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(tangents, Eigen::ComputeThinU);
  const bool has_direction = svd.singularValues()[0] > 1e-9 * scale;
  Vector3d direction = has_direction ? Vector3d(svd.matrixU().col(0)) : Vector3d::Zero();
  Eigen::MatrixXd rest(3, higher.size());
  for (size_t i = 0; i < higher.size(); ++i)
    rest.col(Eigen::Index(i)) = higher[i] - direction * direction.dot(higher[i]);
  if (higher.empty()) return Vector3d::Zero();
  const Eigen::JacobiSVD<Eigen::MatrixXd> span(rest, Eigen::ComputeThinU);
  const auto sigma = [&](Eigen::Index i) { return i < span.singularValues().size() ? span.singularValues()[i] : 0.0; };
  const Eigen::Index needed = has_direction ? 1 : 2;
  if (sigma(needed - 1) <= 1e-9 * scale || sigma(needed) > 1e-6 * sigma(needed - 1)) return Vector3d::Zero();
  Vector3d normal = has_direction ? direction.cross(Vector3d(span.matrixU().col(0)))
                                  : Vector3d(span.matrixU().col(0)).cross(Vector3d(span.matrixU().col(1)));
  normal.normalize();
  const double turn = normal.dot(turn_area);
  if (std::abs(turn) <= 1e-9 * scale * scale) return Vector3d::Zero();
  return turn > 0 ? normal : -normal;
}

}  // namespace sublimit
