// SPDX-License-Identifier: Apache-2.0
#pragma once
// One edge of the scheme of torus pieces: the new point between two points with normals and curvatures.
#include <span>

#include "sublimit/geometric/surface_point.h"

namespace sublimit {

/// A new point.
struct EdgePoint {
  SurfacePoint point;
  bool fell_back = false;  ///< true if no torus piece fits: the point is the middle of the chord, with curvatures 0
};

/// Returns the new point of an edge.
/// @param a, b      the ends; exchanging them changes the result only by rounding
/// @param opposite  the corners opposite to the edge in its triangles. Torus pieces that fit them get larger
///                  weights; if the normals of the ends cancel, theirs decide on the side
EdgePoint torus_edge(const SurfacePoint& a, const SurfacePoint& b, std::span<const SurfacePoint* const> opposite);

}  // namespace sublimit
