// SPDX-License-Identifier: Apache-2.0
#pragma once
// The nearest point of a curve by samples and golden sections between the neighbours of the nearest of them.
#include <Eigen/Core>

#include <functional>
#include <vector>

namespace sublimit {

struct NearestOnLine {
  double s = 0, distance = 0;
};

/// @param curve    points at 0 <= s <= 1
/// @param samples  those at s = i/(count - 1), by rows
NearestOnLine nearest_on_line(const std::function<Eigen::RowVector3d(double)>& curve,
                              const Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>& samples,
                              const Eigen::RowVector3d& point);

}  // namespace sublimit
