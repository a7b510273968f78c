// SPDX-License-Identifier: Apache-2.0
#pragma once
// A part of a mesh: the faces that it owns, and the rings of faces around them that their limits depend on.
// Faces and vertices keep the order of the whole mesh, tags are copied, and complete neighbourhoods have the
// types that they have in the whole. Results on owned faces therefore have the same bits as those of the whole
// mesh.
#include <cstdint>
#include <span>
#include <vector>

#include "sublimit/mesh/mesh.h"
#include "sublimit/mesh/topology.h"

namespace sublimit {

struct MeshPart {
  Mesh mesh;
  std::vector<std::int64_t> vertices;  ///< vertex of the whole mesh, for each vertex of the part; ascending
  std::vector<std::int64_t> faces;     ///< face of the whole mesh, for each face of the part; ascending
  std::vector<char> is_owned;          ///< for each face of the part
};

/// Returns a part of a mesh, without face-varying values. Isolated vertices belong to part 0.
/// @param topology  topology of `whole`
/// @param owner     owning part of each face of `whole`
/// @param part      number of the part to return
/// @param rings     number of rings around the owned faces: faces that share a vertex with them, and so on
/// @throws InvalidMesh  a mesh with knot intervals, which are those of strips that a part does not see to their
///                      ends
MeshPart mesh_part(const Mesh& whole, const Topology& topology, std::span<const int> owner, int part, int rings);

}  // namespace sublimit
