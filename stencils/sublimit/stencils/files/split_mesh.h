// SPDX-License-Identifier: Apache-2.0
#pragma once
// Meshes for formats that have one normal and one texture coordinate per vertex: a vertex becomes several where its
// corners have several values, on seams and creases, and stays one elsewhere.
#include <vector>

#include "sublimit/io/write_mesh.h"

namespace sublimit {

struct SplitMesh {
  Mesh mesh;                   ///< normals and `texture` per vertex
  std::vector<Index> sources;  ///< for each vertex the one that it was; in their order
  /// First corner with the normal of each vertex; -1 for vertices whose source has one normal.
  std::vector<Index> sides;
};

/// @param mesh  the first face-varying channel becomes `texture`: two columns of it, the second one 0 if there is none
/// @pre  corners with normals per corner all have one
/// @note  Normals of a vertex that are less than about 1e-4 apart, in radians, are one: the first one.
SplitMesh split_mesh(Mesh mesh);

}  // namespace sublimit
