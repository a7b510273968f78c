// SPDX-License-Identifier: Apache-2.0
#pragma once
// Checks of points for proofs, measures and searches: they must be finite and, for distances, so small that
// squares do not overflow.
#include <string>

#include "sublimit/core/types.h"

namespace sublimit {

/// Largest absolute coordinate of points between which distances are computed; squares of sums of larger ones
/// may overflow.
inline constexpr double farthest_coordinate = 1e150;

/// Throws unless points of a query are finite and not too far away.
/// @param what  name of a point in the message: "query point"
/// @throws InvalidParameter  a coordinate that is not finite, or above `farthest_coordinate` in modulus; names
///                           the first such point
void check_measurable(const Points& points, const std::string& what);

/// Throws unless control points have three coordinates, if there are any.
/// @throws InvalidMesh  another number of coordinates; names it
void check_in_space(const Points& points);

/// Throws unless control points of a surface that is bounded or integrated are finite.
/// @throws InvalidMesh  a coordinate that is not finite; names the first such point
void check_finite_control(const Points& points);

/// Throws unless control points of a surface that distances are measured to are finite and not too far away.
/// @throws InvalidMesh  a coordinate that is not finite, or above `farthest_coordinate` in modulus; names the
///                      first such point
void check_measurable_control(const Points& points);

}  // namespace sublimit
