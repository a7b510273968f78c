// SPDX-License-Identifier: Apache-2.0
#pragma once
// Closed meshes, which bound a solid: every edge has two faces, and every vertex one fan of faces.
#include "sublimit/mesh/mesh.h"

namespace sublimit {

/// Topological numbers of a closed manifold.
struct ClosedMeshCounts {
  Index euler = 0;       ///< V - E + F: 2 components - 2 handles
  Index components = 0;  ///< number of connected components
  bool operator==(const ClosedMeshCounts&) const = default;
};
/// Returns the numbers of a closed mesh.
/// @throws InvalidMesh  a border, an edge of more than two faces or of two with inconsistent winding, a vertex
///                      with several fans of faces or none; says where
ClosedMeshCounts closed_mesh_counts(const Mesh& mesh);

/// Duplicates vertices with several fans of faces, one for each fan, which separates parts that touch in a
/// point.
/// @return  number of vertices that were split
Index split_pinches(Mesh& mesh);

}  // namespace sublimit
