// SPDX-License-Identifier: Apache-2.0
#pragma once
// Meshes around a solid: every edge has two faces, every vertex one fan of them.
#include "sublimit/mesh/mesh.h"

namespace sublimit {

/// Numbers of elements of a closed manifold.
struct ClosedMeshCounts {
  Index euler = 0;       ///< V - E + F: 2 components - 2 handles
  Index components = 0;  ///< that faces hang together in
  bool operator==(const ClosedMeshCounts&) const = default;
};
/// @throws InvalidMesh  a border, an edge of more than two faces or of two with the same winding, a vertex with several
///                      fans of faces or none: says where
ClosedMeshCounts closed_mesh_counts(const Mesh& mesh);

/// Vertices where several fans of faces meet, as often as there are fans: what touches itself at a point does so no
/// more.
/// @return  how many were split
Index split_pinches(Mesh& mesh);

}  // namespace sublimit
