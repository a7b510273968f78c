// SPDX-License-Identifier: Apache-2.0
#pragma once
// A part of a mesh: faces that it owns, and around them what their limits depend on. In the part all is as in the
// whole: faces and vertices keep their order, tags travel along, and a neighbourhood that is inside has the type that
// it has there. What is computed of owned faces has therefore the same bits.
#include <cstdint>
#include <span>
#include <vector>

#include "sublimit/mesh/mesh.h"
#include "sublimit/mesh/topology.h"

namespace sublimit {

struct MeshPart {
  Mesh mesh;
  std::vector<std::int64_t> vertices;  ///< vertex of the whole mesh, for each of its own; ascending
  std::vector<std::int64_t> faces;     ///< likewise
  std::vector<char> is_owned;          ///< for each of its faces
};

/// @param topology  of the whole
/// @param owner     of each of its faces
/// @param part      which owner's
/// @param rings     faces around owned ones: those that share a vertex with them, and so on
/// Vertices of no face are those of part 0. Face-varying values stay behind.
/// @throws InvalidMesh  knot intervals
MeshPart mesh_part(const Mesh& whole, const Topology& topology, std::span<const int> owner, int part, int rings);

}  // namespace sublimit
