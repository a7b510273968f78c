// SPDX-License-Identifier: Apache-2.0
#pragma once
// What is inside a closed surface: how often it winds around a point, counted where a ray from there leaves it
// and comes back (intersect.h misses no hit).
#include <vector>

#include "sublimit/search/detail/searched_surface.h"

namespace sublimit {

/// 0 outside, 1 inside, -1 inside a surface whose normals look inwards; others where it intersects itself. Of points on
/// the surface either side's. Where rays may miss hits, as of schemes without polynomials (intersect.h), an estimate.
/// @throws InvalidParameter     points that do not fit, or are not finite
/// @throws UnsupportedTopology  a surface that is not closed: says where
/// @throws AnalysisError        a point from which rays of all directions were given up
std::vector<int> winding_numbers(const SearchedSurface& surface, const Points& queries);

}  // namespace sublimit
