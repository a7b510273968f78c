// SPDX-License-Identifier: Apache-2.0
#pragma once
// Tessellation by rates, the number of segments of each edge of the mesh. Points on an edge depend only on its
// rate, so faces meet without cracks. Inside, a face has a uniform grid of its largest rates, joined to its
// sides by a strip. OpenSubdiv's Bfr::Tessellation has the same interface.
#include <span>

#include "sublimit/tessellation/tessellate.h"

namespace sublimit {

/// Returns the triangles of a surface without its holes, for any scheme.
/// @param rates  rate of each edge of the surface's level, >= 1. Rates of edges of polygons other than
///               quadrilaterals, which become squares at their corners, are rounded up to even numbers
/// @return  triangles; `bound` is 0 and has no meaning, since no distance is proved
/// @throws InvalidParameter  another number of rates, a rate below 1 or above 2^22
/// @throws ResourceError     more than `max_triangles` triangles; thrown before they are made
Tessellation tessellate_by_rates(const LimitMap& surface, const Points& control, std::span<const Index> rates,
                                 std::int64_t max_triangles = TessellationOptions{}.max_triangles);

}  // namespace sublimit
