// SPDX-License-Identifier: Apache-2.0
#pragma once
// The mesh around a centre, from labels alone: n sectors of a regular grid, `rings` of them.
#include <map>

#include "sublimit/mesh/mesh.h"
#include "sublimit/neighborhood/sector_labels.h"

namespace sublimit {

struct SectorMesh {
  Mesh mesh;                        ///< positions zero
  std::vector<SectorLabel> labels;  ///< by vertex, sector by sector within a ring of squares or triangles
  std::map<SectorLabel, Index> find;
  std::vector<int> ring;  ///< by face: 0 next to the centre (the face itself too), then outwards
};

/// @param n          sectors: valence of the vertex, corners of the face, or faces of an open fan
/// @param face_size  3 or 4, of the faces around a vertex; 4 around a face
/// @param rings      of faces around the centre, >= 1
/// @param open       the fan of a border vertex; not for faces
SectorMesh sector_mesh(Centre::Kind kind, int n, int face_size, int rings, bool open = false);

}  // namespace sublimit
