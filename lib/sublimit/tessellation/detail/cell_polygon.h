// SPDX-License-Identifier: Apache-2.0
#pragma once
// Convex polygons in the parameters of a face, cut into triangles.
#include <vector>

#include "sublimit/nets/piece_parts.h"
#include "sublimit/tessellation/tessellate.h"

namespace sublimit {

struct PolygonCorner {
  Index vertex;
  CellCorner at;
};

/// Appends a triangle, counter-clockwise.
void add_triangle(Index address, const PolygonCorner& a, const PolygonCorner& b, const PolygonCorner& c,
                  Tessellation& made);

/// Cuts a convex polygon into triangles: repeatedly cuts off the corner with the best shape among those with an
/// area in parameters, which always exists, even if corners lie in the middle of sides.
/// @param polygon  indices of points of `made`; modified
void triangulate(Index address, std::vector<PolygonCorner>& polygon, Tessellation& made);

}  // namespace sublimit
