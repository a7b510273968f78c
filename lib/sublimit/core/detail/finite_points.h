// SPDX-License-Identifier: Apache-2.0
#pragma once
// Points that proofs, measures and searches can be about: finite, and where distances are taken not so large that their
// squares are not.
#include <string>

#include "sublimit/core/types.h"

namespace sublimit {

/// Largest coordinate, in size, of points between which distances are taken: squares of sums of larger ones are no
/// numbers.
inline constexpr double farthest_coordinate = 1e150;

/// Throws unless points of a query are finite and not too far away.
/// @param what  one of them, for the message: "query point"
/// @throws InvalidParameter  a coordinate is not finite, or above `farthest_coordinate` in size, naming the first such
///                           point
void check_measurable(const Points& points, const std::string& what);

/// Throws unless control points have three coordinates, if there are any.
/// @throws InvalidMesh  says how many they have
void check_in_space(const Points& points);

/// Throws unless control points of a surface that is bounded or integrated are finite.
/// @throws InvalidMesh  a coordinate is not finite, naming the first such point
void check_finite_control(const Points& points);

/// Throws unless control points of a surface that distances are measured to are finite and not too far away.
/// @throws InvalidMesh  a coordinate is not finite, or above `farthest_coordinate` in size, naming the first such point
void check_measurable_control(const Points& points);

}  // namespace sublimit
