// SPDX-License-Identifier: Apache-2.0
#pragma once
// Quads packed into rectangles: as many as one B-spline with simple knots holds, never across a sharp edge,
// nor of different names.
#include <vector>

#include "sublimit/cad/boundary_model.h"
#include "sublimit/cad/quad_edges.h"

namespace sublimit {

/// A rotated quad: its corner `turn` is the lower left one.
struct TurnedQuad {
  Index quad = -1;
  int turn = 0;
  bool operator==(const TurnedQuad&) const = default;
};

/// Quads of the rectangle, row by row from below, each from the left.
using QuadRectangle = std::vector<std::vector<TurnedQuad>>;

/// Every quad is in one of them.
/// @param pack   else each is alone
/// @param names  numbers, a quad each: those of a rectangle have the same; empty: any may be together
std::vector<QuadRectangle> quad_rectangles(const std::vector<LimitQuad>& quads, const QuadEdges& edges, bool pack,
                                           const std::vector<Index>& names = {});

/// Faces of rectangles, in their order, with shared edges: those that follow each other smoothly along the same two
/// faces are one.
BoundaryModel boundary_model(const std::vector<LimitQuad>& quads, const QuadEdges& edges,
                             const std::vector<QuadRectangle>& rectangles);

}  // namespace sublimit
