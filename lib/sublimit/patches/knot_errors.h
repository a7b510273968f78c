// SPDX-License-Identifier: Apache-2.0
#pragma once
// Checks of knots, shared by all number types. Errors are InvalidParameter and name the knot and the control point,
// with the counts that would be right; numbers are reported as the nearest double.
//
//   check_degree(degree);
//   const bool ends_left_out = check_knot_count(degree, num_points, knots.size());
#include "sublimit/core/types.h"

namespace sublimit {

/// Largest degree of B-splines.
inline constexpr int max_degree = 25;

/// What is wrong with a knot.
enum class KnotFault {
  not_finite,
  falling,         ///< less than the knot before
  too_near,        ///< too near to the knot before for a knot between them
  missing,         ///< a coarse knot that the finer knots lack
  another_domain,  ///< finer knots with another domain
};

/// Throws unless a degree is 0 to max_degree.
/// @throws InvalidParameter  another degree
void check_degree(int degree);
/// Throws unless the number of knots fits that of control points.
/// @return  true if the first and the last knot are left out
/// @throws InvalidParameter  too few points, or neither n + p + 1 nor n + p - 1 knots
bool check_knot_count(int degree, Index points, std::size_t knots);
/// Throws unless two degrees are equal.
/// @throws InvalidParameter  different degrees
void check_same_degree(int wanted, int degree);
/// Throws unless a closed curve has at least two break points.
/// @param breaks  number of break points: one more than control points
/// @throws InvalidParameter  fewer
void check_break_count(std::size_t breaks);
/// Reports a fault of a knot.
/// @param knot   number of the knot
/// @param value  the knot
/// @param other  the knot before, or the end of the correct domain
/// @throws InvalidParameter  always
[[noreturn]] void refuse_knot(KnotFault fault, Index knot, double value, double other = 0);
/// Reports more than degree + 1 equal knots, the first of them number `knot`: a control point has no influence.
/// @throws InvalidParameter  always
[[noreturn]] void refuse_multiplicity(int degree, Index knot, double value, Index times, Index point);
/// Reports a domain without length, from knot `first` to knot `last`.
/// @throws InvalidParameter  always
[[noreturn]] void refuse_domain(Index first, Index last, double value);
/// Reports a parameter outside the domain.
/// @throws InvalidParameter  always
[[noreturn]] void refuse_parameter(double t, double begin, double end);

}  // namespace sublimit
