// SPDX-License-Identifier: Apache-2.0
#pragma once
// Powers of the parameter as splines: the blossom of t^k at x_1 .. x_n is e_k(x_1 .. x_n) / C(n, k), e_k the elementary
// symmetric polynomial. Taken at a spline's consecutive knots it is the control point of t^k: Greville's abscissae for
// k = 1, and Marsden's identity.
// Source: Ramshaw 1989, "Blossoms are polar forms".
#include <span>
#include <vector>

#include "sublimit/patches/knots.h"

namespace sublimit {

/// Blossoms of 1, t, .., t^highest as polynomials of degree #arguments.
/// @param highest  0 to #arguments
std::vector<double> blossoms_of_powers(std::span<const double> arguments, int highest);

/// Control points of polynomials: #points x #polynomials.
/// @param coefficients  #polynomials x (highest power + 1), that of 1 first
/// @param knots         open, of no lower degree
Eigen::MatrixXd polynomial_points(const Knots<double>& knots, const Eigen::MatrixXd& coefficients);

/// The cubic Hermite polynomials of value at 0, value at 1, derivative at 0, derivative at 1: F1 .. F4, by rising
/// powers, a row each.
Eigen::Matrix4d hermite_coefficients();

/// Control points of a cubic Bezier curve from P0, P1, T0, T1: a row each.
Eigen::Matrix4d hermite_to_bezier();

}  // namespace sublimit
