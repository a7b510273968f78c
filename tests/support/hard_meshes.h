// SPDX-License-Identifier: Apache-2.0
#pragma once
// Meshes that have everything at once: irregular vertices and faces side by side, borders, and sharp edges of all kinds
// that meet, end, and differ from edge to edge. Manifold; the same seed, the same mesh.
#include "support/meshes.h"

namespace sublimit::testing {

struct Hardness {
  bool open = false;   ///< with two or more borders
  bool sharp = false;  ///< infinitely sharp creases, closed or from border to border, crossings and corners, no darts
  bool semi_sharp =
      false;  ///< sharpness 0.3 to 5.7 in paths, neighbours differing, with darts; some infinite; sharp vertices
};

/// Valences and corners of faces from 3 to 12 (borders: vertices of one face and more).
Mesh hard_polygons(unsigned seed, const Hardness& hardness = {});
/// Triangles, valences from 3 to 12.
Mesh hard_triangles(unsigned seed, const Hardness& hardness = {});

}  // namespace sublimit::testing
