// SPDX-License-Identifier: Apache-2.0
#pragma once
// Nearest point of a curve, by samples and golden section search between the neighbours of the nearest sample.
#include <Eigen/Core>

#include <functional>
#include <vector>

namespace sublimit {

/// Parameter and distance of a nearest point.
struct NearestOnLine {
  double s = 0, distance = 0;
};

/// Returns the nearest point of a curve to `point`.
/// @param curve    returns the point at s, 0 <= s <= 1
/// @param samples  points at s = i/(count - 1), a row each
NearestOnLine nearest_on_line(const std::function<Eigen::RowVector3d(double)>& curve,
                              const Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>& samples,
                              const Eigen::RowVector3d& point);

}  // namespace sublimit
