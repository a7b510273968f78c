// SPDX-License-Identifier: Apache-2.0
#pragma once
// What is refused in knots, and how it is said: InvalidParameter naming the knot and the control point, and the counts
// that would be right. Numbers of any type are named by the nearest double.
#include "sublimit/core/types.h"

namespace sublimit {

/// Largest degree of B-splines: rows have one weight more in each variable.
inline constexpr int max_degree = 25;

enum class KnotFault {
  not_finite,
  falling,         ///< less than the one before
  too_near,        ///< to the one before, to be halved
  missing,         ///< finer knots lack one of the coarser ones
  another_domain,  ///< finer knots have another domain
};

/// @throws InvalidParameter  not 0 to max_degree
void check_degree(int degree);
/// @throws InvalidParameter  too few points, or neither n + p + 1 nor n + p - 1 knots
/// @return  whether the first and the last knot are left out
bool check_knot_count(int degree, Index points, std::size_t knots);
/// @throws InvalidParameter  degrees that differ
void check_same_degree(int wanted, int degree);
/// @param breaks  of a closed curve: one more than control points
void check_break_count(std::size_t breaks);
/// @param knot   its number
/// @param value  the knot
/// @param other  the one before, or the end of the right domain
[[noreturn]] void refuse_knot(KnotFault fault, Index knot, double value, double other = 0);
/// More than degree + 1 equal knots, the first of them `knot`: a control point has no influence.
[[noreturn]] void refuse_multiplicity(int degree, Index knot, double value, Index times, Index point);
[[noreturn]] void refuse_domain(Index first, Index last, double value);
[[noreturn]] void refuse_parameter(double t, double begin, double end);

}  // namespace sublimit
