// SPDX-License-Identifier: Apache-2.0
#pragma once
// Triangles by rates: into how many segments each edge of the mesh is cut. Points on an edge depend on its rate alone,
// so faces meet without cracks; inside, a face has a uniform grid of its largest rates, joined to its sides by a strip.
// OpenSubdiv's Bfr::Tessellation is asked the same way.
#include <span>

#include "sublimit/tessellation/tessellate.h"

namespace sublimit {

/// @param rates  for each edge of the surface's level, >= 1. Edges of polygons other than quadrilaterals, which become
///               squares at their corners, have the next even one
/// @return  triangles of all but holes; `bound` is 0 and means nothing: no distance is proved. Every scheme is taken
/// @throws InvalidParameter  another number of rates, one below 1 or above 2^22
/// @throws ResourceError     more triangles than allowed: before they are made
Tessellation tessellate_by_rates(const LimitMap& surface, const Points& control, std::span<const Index> rates,
                                 std::int64_t max_triangles = TessellationOptions{}.max_triangles);

}  // namespace sublimit
