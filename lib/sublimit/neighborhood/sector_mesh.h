// SPDX-License-Identifier: Apache-2.0
#pragma once
// Meshes around a centre made of n sectors of a regular grid.
#include <map>

#include "sublimit/mesh/mesh.h"
#include "sublimit/neighborhood/sector_labels.h"

namespace sublimit {

/// A mesh with its sector labels.
struct SectorMesh {
  Mesh mesh;                          ///< positions zero
  std::vector<SectorLabel> labels;    ///< by vertex, sector by sector within a ring of squares or triangles
  std::map<SectorLabel, Index> find;  ///< vertex by label
  std::vector<int> ring;  ///< by face: 0 at the centre (also for the centre face itself), ascending outwards
};

/// Returns the mesh around a centre.
/// @param n          number of sectors: valence of the vertex, corners of the face, or faces of an open fan
/// @param face_size  size of the faces: 3 or 4 around a vertex, 4 around a face
/// @param rings      rings of faces around the centre, >= 1
/// @param open       true: the centre is a border vertex
SectorMesh sector_mesh(Centre::Kind kind, int n, int face_size, int rings, bool open = false);

}  // namespace sublimit
