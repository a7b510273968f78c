// SPDX-License-Identifier: Apache-2.0
#pragma once
// Curves by samples: how far apart two are, and the nearest point of one, by golden section search between the
// neighbours of the nearest sample.
#include <Eigen/Core>

#include <functional>

#include "sublimit/core/types.h"

namespace sublimit {

/// Returns the largest distance between two curves at equal parameters; not a number if a sample is not finite.
/// @param a, b      samples at evenly spaced parameters, as many of each
/// @param reversed  true: the second curve is traversed backwards
double curve_distance(const Eigen::Ref<const Points>& a, const Eigen::Ref<const Points>& b, bool reversed);

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
