// SPDX-License-Identifier: Apache-2.0
#pragma once
// Symmetric convex hulls of points: how a vector is combined from +- the points with the least sum of moduli.
#include <Eigen/Core>

#include <optional>

namespace sublimit {

/// Coefficients c with sum c_j points.row(j) = x, up to rounding, and sum |c_j| (nearly) least, by the simplex method.
/// The first rows of `points` are a multiple of the identity. Nothing is promised of rounding: verify what you use.
/// @param level  where given, the sum is only wanted to compare with it: the search ends as soon as that is decided
Eigen::RowVectorXd least_combination(const Eigen::MatrixXd& points, const Eigen::RowVectorXd& x,
                                     std::optional<double> level = {});

}  // namespace sublimit
