// SPDX-License-Identifier: Apache-2.0
#pragma once
// Interpolating splines: rows of the spline at the parameters, and the solution of one linear system.
//
//   sum_j N_j(tau_i) P_j = Q_i      solvable iff N_i(tau_i) > 0 for each i
//
// Source: Schoenberg, Whitney 1953; de Boor 1978, "A Practical Guide to Splines", chapters IV and XIII.
#include <span>
#include <string>
#include <vector>

#include "sublimit/patches/constructions/spline_net.h"

namespace sublimit {

/// A condition on a derivative at a parameter, per unit of the knots.
struct SplineCondition {
  double t = 0;
  int order = 0;  ///< 0 to 2
};

/// Returns conditions as rows over the control points.
SparseMatrix condition_rows(const Knots<double>& knots, std::span<const SplineCondition> conditions);

/// Returns the control points that satisfy as many conditions as there are control points.
/// @param values  a row for each condition
/// @throws InvalidParameter  another number of conditions or values; linearly dependent conditions
Points solve_conditions(const Knots<double>& knots, std::span<const SplineCondition> conditions, const Points& values);

/// Returns clamped knots for one control point per parameter; inner knots are means of `degree` consecutive
/// parameters.
/// @param parameters  strictly ascending
/// @throws InvalidParameter  parameters that do not ascend, naming their indices; fewer than degree + 1
Knots<double> averaged_knots(int degree, std::span<const double> parameters);
/// Returns averaged knots over a domain that contains the parameters.
Knots<double> averaged_knots(int degree, std::span<const double> parameters, double begin, double end);

/// Returns the control points of the spline with given values at parameters, one parameter per control point.
/// @throws InvalidParameter  parameters that descend, or violate the Schoenberg-Whitney condition (each must
///                           lie in the support of its basis function); names parameters and knots
Points interpolating_points(const Knots<double>& knots, std::span<const double> parameters, const Points& values);

/// End conditions of a cubic spline.
enum class CubicEnds { natural, clamped, periodic };
/// Names of the end conditions in files.
inline constexpr const char* cubic_ends_words[] = {"natural", "clamped", "periodic"};

/// Returns the cubic spline through points, C^2 with a knot at every parameter.
/// @param points           one for each parameter; for `periodic` the last repeats the first, or is left out
/// @param end_derivatives  for `clamped`: 2 rows, per unit of the parameter
/// @throws InvalidParameter  wrong counts; parameters that do not ascend
/// @throws InvalidMesh       a periodic curve whose last point differs from the first, with the gap
CurveNet interpolating_cubic(CubicEnds ends, std::span<const double> parameters, const Points& points,
                             const Points& end_derivatives = {});

}  // namespace sublimit
