// SPDX-License-Identifier: Apache-2.0
#pragma once
// Winding numbers of a closed surface around points, counted along a ray from the point by the sides of its
// hits (intersect.h misses no hit).
#include <vector>

#include "sublimit/parts/parted_surface.h"

namespace sublimit {

/// Returns the winding number around each point: 0 outside, 1 inside, -1 inside a surface with inward normals;
/// other values if the surface intersects itself. For points on the surface it is that of either side. The
/// result is an estimate if rays may miss hits, as for schemes without polynomials (intersect.h).
/// @throws InvalidParameter     queries of another shape, or not finite
/// @throws UnsupportedTopology  a surface that is not closed; says where
/// @throws AnalysisError        a point from which no ray could be decided
std::vector<int> winding_numbers(const PartedSurface& surface, const Points& queries);

}  // namespace sublimit
