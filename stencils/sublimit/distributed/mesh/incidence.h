// SPDX-License-Identifier: Apache-2.0
#pragma once
// Incidence of a mesh that no process has whole: each rank knows the faces at the vertices of its run, and the
// neighbours of the faces of its run.
#include "sublimit/distributed/mesh/spread_mesh.h"

namespace sublimit {

struct Incidence {
  Lists faces;       ///< faces at each vertex of this rank's run, ascending
  Lists neighbours;  ///< for each face of this rank's run: faces that share an edge, ascending
  /// For each face of this rank's run: number of its edges, and of its vertices, that no face of lower number
  /// has.
  std::vector<std::int32_t> own_sides, own_corners;
  Lists creases;  ///< at the lower vertex of each edge: other vertex, bits of the sharpness, ...
  Lists corners;  ///< at each vertex: bits of the sharpness, in the order of the file
  std::vector<char> is_hole;
  std::vector<std::int64_t> isolated;  ///< vertices of this rank's run that are in no face
  bool has_creases = false, has_corners = false, has_holes = false;  ///< true if any rank has some
};

/// Returns this rank's incidence. Collective: all ranks call.
/// @param name  name of the mesh for messages
/// @throws InvalidMesh  on all ranks: a crease where no face has an edge
Incidence incidence(const Ranks& ranks, const SpreadMesh& mesh, const std::string& name);

}  // namespace sublimit
