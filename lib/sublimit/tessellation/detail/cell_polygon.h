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

/// Cuts off the roundest corner that has an area in parameters, until a triangle is left. A convex polygon, corners in
/// the middle of sides included, always has one.
/// @param polygon  of points of `made`; used up
void triangulate(Index address, std::vector<PolygonCorner>& polygon, Tessellation& made);

}  // namespace sublimit
