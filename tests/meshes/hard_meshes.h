// SPDX-License-Identifier: Apache-2.0
#pragma once
// Random manifold meshes with all difficulties at once: adjacent irregular vertices and faces, borders, and
// sharp edges of all kinds that meet, end, and vary from edge to edge. Equal seeds give equal meshes.
#include "meshes/meshes.h"

namespace sublimit::testing {

struct Hardness {
  bool open = false;   ///< with two or more borders
  bool sharp = false;  ///< infinitely sharp creases, closed or from border to border, crossings and corners, no darts
  bool semi_sharp =
      false;  ///< sharpness 0.3 to 5.7 in paths, neighbours differing, with darts; some infinite; sharp vertices
};

/// Returns a mesh of polygons with valences and face sizes from 3 to 12; border vertices have one face or more.
Mesh hard_polygons(unsigned seed, const Hardness& hardness = {});
/// Returns a mesh of triangles with valences from 3 to 12.
Mesh hard_triangles(unsigned seed, const Hardness& hardness = {});

}  // namespace sublimit::testing
