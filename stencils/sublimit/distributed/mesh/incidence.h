// SPDX-License-Identifier: Apache-2.0
#pragma once
// Which faces are at which vertices and beside which faces, of a mesh that no process has whole: the rank that has a
// vertex or a face in its run knows.
#include "sublimit/distributed/mesh/spread_mesh.h"

namespace sublimit {

struct Incidence {
  Lists faces;       ///< at each vertex of the own run, ascending
  Lists neighbours;  ///< of each face of the own run: those that share an edge, ascending
  /// Of each face of the own run: how many of its edges and vertices are in no face of a lower number.
  std::vector<std::int32_t> own_sides, own_corners;
  Lists creases;  ///< at the lower end of their edges: head, sharpness as bits, head, ... in the order of the file
  Lists corners;  ///< at their vertex: sharpness as bits, in the order of the file
  std::vector<char> is_hole;
  std::vector<std::int64_t> isolated;                                ///< vertices of the own run that are in no face
  bool has_creases = false, has_corners = false, has_holes = false;  ///< of the whole
};

/// @param name  of the mesh
/// @throws InvalidMesh  on all ranks: a crease where no face has an edge
Incidence incidence(const Ranks& ranks, const SpreadMesh& mesh, const std::string& name);

}  // namespace sublimit
