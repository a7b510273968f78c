// SPDX-License-Identifier: Apache-2.0
#pragma once
// Splines through given points: rows of the spline at the parameters, and one solve.
//
//   sum_j N_j(tau_i) P_j = Q_i      solvable iff N_i(tau_i) > 0 for each i
//
// Source: Schoenberg, Whitney 1953; de Boor 1978, "A Practical Guide to Splines", chapters IV and XIII.
#include <span>
#include <string>
#include <vector>

#include "sublimit/patches/constructions/spline_net.h"

namespace sublimit {

/// The derivative of some order at a parameter is a given value, per unit of the knots.
struct SplineCondition {
  double t = 0;
  int order = 0;  ///< 0 to 2
};

/// Returns conditions as rows over the control points.
SparseMatrix condition_rows(const Knots<double>& knots, std::span<const SplineCondition> conditions);

/// Control points that meet as many conditions as there are of them.
/// @param values  a row for each condition
/// @throws InvalidParameter  another number of conditions or values; conditions that depend on each other
Points solve_conditions(const Knots<double>& knots, std::span<const SplineCondition> conditions, const Points& values);

/// Clamped knots whose inner ones are the means of `degree` consecutive parameters, for a control point at each.
/// @param parameters  rising
/// @throws InvalidParameter  equal or falling parameters, by their numbers; fewer than degree + 1
Knots<double> averaged_knots(int degree, std::span<const double> parameters);
/// Returns averaged knots over a domain that contains the parameters.
Knots<double> averaged_knots(int degree, std::span<const double> parameters, double begin, double end);

/// Control points of the spline that has given values at parameters, one for each control point.
/// @throws InvalidParameter  parameters that fall or lie outside the support of their basis function: Schoenberg and
///                           Whitney's condition, naming parameters and knots
Points interpolating_points(const Knots<double>& knots, std::span<const double> parameters, const Points& values);

enum class CubicEnds { natural, clamped, periodic };
/// Names of the end conditions in files.
inline constexpr const char* cubic_ends_words[] = {"natural", "clamped", "periodic"};

/// The cubic spline through points, C^2 with a knot at every parameter.
/// @param points           one for each parameter; of a periodic one the last is the first again, or left out
/// @param end_derivatives  of `clamped`: 2 rows, per unit of the parameter
/// @throws InvalidParameter  counts; parameters that do not rise
/// @throws InvalidMesh       a periodic curve whose last point is another one than its first, with the gap
CurveNet interpolating_cubic(CubicEnds ends, std::span<const double> parameters, const Points& points,
                             const Points& end_derivatives = {});

}  // namespace sublimit
