// SPDX-License-Identifier: Apache-2.0
#pragma once
// Meshes for formats that have one normal and one texture coordinate per vertex. Vertices on seams and creases,
// whose corners have several values, are split into several vertices.
#include <vector>

#include "sublimit/io/write_mesh.h"

namespace sublimit {

struct SplitMesh {
  Mesh mesh;                   ///< normals and `texture` per vertex
  std::vector<Index> sources;  ///< vertex of the given mesh for each vertex, ascending
  /// First corner with the normal of each vertex; -1 for vertices whose source has one normal.
  std::vector<Index> sides;
};

/// Splits the vertices of a mesh.
/// @param mesh  its first face-varying channel becomes `texture`: the first two columns, the second one 0 if
///              absent
/// @pre  normals per corner exist at all corners, if there are any
/// @note  Normals of a vertex less than about 1e-4 radians apart are treated as one, the first.
SplitMesh split_mesh(Mesh mesh);

}  // namespace sublimit
