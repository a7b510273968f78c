// SPDX-License-Identifier: Apache-2.0
#pragma once
// Packing of quads into rectangles that are one B-spline with simple knots each, never across sharp edges or
// between different names.
#include <vector>

#include "sublimit/cad/boundary_model.h"
#include "sublimit/cad/quad_edges.h"

namespace sublimit {

/// A rotated quad, whose corner `turn` is the lower left one.
struct TurnedQuad {
  Index quad = -1;
  int turn = 0;
  bool operator==(const TurnedQuad&) const = default;
};

/// A rectangle of quads: rows from below, each from the left.
using QuadRectangle = std::vector<std::vector<TurnedQuad>>;

/// Returns rectangles that contain each quad once.
/// @param pack   false: one rectangle per quad
/// @param names  a number per quad: quads of a rectangle have the same number; empty: no restriction
std::vector<QuadRectangle> quad_rectangles(const std::vector<LimitQuad>& quads, const QuadEdges& edges, bool pack,
                                           const std::vector<Index>& names = {});

/// Returns a model with a face for each rectangle, in order, and shared edges. Consecutive smooth edges between
/// the same two faces are merged.
BoundaryModel boundary_model(const std::vector<LimitQuad>& quads, const QuadEdges& edges,
                             const std::vector<QuadRectangle>& rectangles);

}  // namespace sublimit
