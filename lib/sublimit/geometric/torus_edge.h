// SPDX-License-Identifier: Apache-2.0
#pragma once
// One edge of the scheme of torus pieces: the new point between two points with normals and curvatures.
#include <span>

#include "sublimit/geometric/surface_point.h"

namespace sublimit {

struct EdgePoint {
  SurfacePoint point;
  bool fell_back = false;  ///< no torus piece fits: the middle of the chord, flat
};

/// @param a, b      the ends; exchanging them changes nothing but rounding
/// @param opposite  the corners opposite to the edge in its triangles. Of torus pieces that suit both ends alike those
///                  count more that suit these; and their normals tell the side where the ends' normals cancel.
EdgePoint torus_edge(const SurfacePoint& a, const SurfacePoint& b, std::span<const SurfacePoint* const> opposite);

}  // namespace sublimit
