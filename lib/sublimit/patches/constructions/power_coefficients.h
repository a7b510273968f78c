// SPDX-License-Identifier: Apache-2.0
#pragma once
// Powers of the parameter as splines: the blossom of t^k at x_1 .. x_n is e_k(x_1 .. x_n) / C(n, k), e_k the elementary
// symmetric polynomial. At consecutive knots of a spline it is the control point of t^k (Marsden's identity),
// for k = 1 the Greville abscissa.
// Source: Ramshaw 1989, "Blossoms are polar forms".
#include <span>
#include <vector>

#include "sublimit/patches/knots.h"

namespace sublimit {

/// Returns the blossoms of 1, t, .., t^highest, as polynomials of degree #arguments.
/// @param highest  0 to #arguments
std::vector<double> blossoms_of_powers(std::span<const double> arguments, int highest);

/// Returns the control points of polynomials: #points x #polynomials.
/// @param coefficients  #polynomials x (highest power + 1), that of 1 first
/// @param knots         open knots of at least this degree
Eigen::MatrixXd polynomial_points(const Knots<double>& knots, const Eigen::MatrixXd& coefficients);

/// Returns the coefficients of the cubic Hermite polynomials F1 .. F4 (of value at 0, value at 1, derivative at
/// 0, derivative at 1), a row each, by ascending powers.
Eigen::Matrix4d hermite_coefficients();

/// Returns the matrix from P0, P1, T0, T1 to the control points of a cubic Bezier curve, a row each.
Eigen::Matrix4d hermite_to_bezier();

}  // namespace sublimit
