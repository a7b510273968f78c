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

/// Points that a caller asks about.
/// @param what  one of them, for the message: "query point"
/// @throws InvalidParameter  a coordinate is not finite, or above `farthest_coordinate` in size, naming the first such
///                           point
void check_measurable(const Points& points, const std::string& what);

/// Control points of what is bounded or integrated.
/// @throws InvalidMesh  a coordinate is not finite, naming the first such point
void check_finite_control(const Points& points);

/// Control points of what distances are taken to.
/// @throws InvalidMesh  a coordinate is not finite, or above `farthest_coordinate` in size, naming the first such point
void check_measurable_control(const Points& points);

}  // namespace sublimit
