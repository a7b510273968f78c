// SPDX-License-Identifier: Apache-2.0
#pragma once
// Meshes for formats that have one normal and one texture coordinate per vertex. Vertices on seams and creases,
// whose corners have several values, are split into several vertices.
#include <vector>

#include "sublimit/mesh/mesh.h"

namespace sublimit {

/// Vertices of a mesh so split that each has one normal and one value.
struct SplitVertices {
  /// A vertex of the file.
  struct Vertex {
    Index source;  ///< vertex of the mesh
    Index value;   ///< row of the channel, -1 for none
    Index normal;  ///< row of the normals per corner, -1 for none
    Index corner;  ///< the first corner there
    Index side;    ///< the first corner with this normal; -1 where the source has one normal
  };
  std::vector<Vertex> vertices;  ///< by their sources, which ascend
  std::vector<Index> corners;    ///< vertex of each corner
};

/// Splits the vertices of a mesh. Vertices in no face are left out.
/// @param channel  values of corners; null for none
/// @note  Normals of a vertex less than about 1e-4 radians apart are treated as one, the first.
SplitVertices split_vertices(const Mesh& mesh, const Mesh::FaceVarying* channel);

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
