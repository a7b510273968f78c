// SPDX-License-Identifier: Apache-2.0
#pragma once
// Symmetric convex hulls of points: combinations of a vector from points with the least sum of absolute
// coefficients.
#include <Eigen/Core>

#include <optional>

namespace sublimit {

/// Returns coefficients c with sum c_j points.row(j) = x and (nearly) the least sum |c_j|, by the simplex
/// method, up to rounding errors without a bound: callers must verify the result.
/// @param points  the first rows are a multiple of the identity
/// @param level   if given, the search ends as soon as it is decided whether the least sum is below it
Eigen::RowVectorXd least_combination(const Eigen::MatrixXd& points, const Eigen::RowVectorXd& x,
                                     std::optional<double> level = {});

}  // namespace sublimit
