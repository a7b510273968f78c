// SPDX-License-Identifier: Apache-2.0
#pragma once
// Sums from which integrals over a surface are computed, over its pieces or over the triangles of a mesh near
// it.
#include <Eigen/Core>

namespace sublimit {

/// Integrals over parts of a surface, with X = (x, y, z), N = X_u x X_v and dV = (X.N) du dv. They add up.
struct SurfaceSums {
  double area = 0;
  Eigen::Vector3d of_area = Eigen::Vector3d::Zero();  ///< integral of X |N| du dv
  double volume = 0;                                  ///< integral of dV / 3
  Eigen::Vector3d first = Eigen::Vector3d::Zero();    ///< integral of X dV / 4
  Eigen::Matrix3d second = Eigen::Matrix3d::Zero();   ///< integral of X X^T dV / 5

  SurfaceSums& operator+=(const SurfaceSums& other) {
    area += other.area;
    of_area += other.of_area;
    volume += other.volume;
    first += other.first;
    second += other.second;
    return *this;
  }

  /// All sums in one vector, in the order of the members.
  using Numbers = Eigen::Matrix<double, 17, 1>;
  Numbers numbers() const {
    Numbers n;
    n << area, of_area, volume, first, second.col(0), second.col(1), second.col(2);
    return n;
  }
  /// Returns the sums of such a vector.
  static SurfaceSums of(const Numbers& n) {
    return {n[0], n.segment<3>(1), n[4], n.segment<3>(5), Eigen::Map<const Eigen::Matrix3d>(n.data() + 8)};
  }
};

/// Sums with an estimate of the absolute error of each.
struct EstimatedSums {
  SurfaceSums value, error;
  EstimatedSums& operator+=(const EstimatedSums& other) {
    value += other.value;
    error += other.error;
    return *this;
  }
};

}  // namespace sublimit
