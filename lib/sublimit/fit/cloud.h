// SPDX-License-Identifier: Apache-2.0
#pragma once
// Point clouds: points without order that a surface should be near to.
#include <vector>

#include "sublimit/mesh/control_mesh.h"

namespace sublimit {

struct Cloud {
  Points points;                     ///< #points x 3
  std::vector<double> weights = {};  ///< >= 0, of the squared distances; empty: all 1
};

/// The vertices of a mesh that belong to faces, each with its share of their area: a third of every triangle, polygons
/// cut into triangles from their first corner.
/// @throws InvalidMesh  a position that is not finite, a corner that is no vertex
Cloud cloud_of_vertices(const ControlMesh& mesh);

/// Points all over the faces of a mesh, equally many for equal areas, of equal weight; the same seed, the same points.
/// @throws InvalidMesh       as above, and faces without any area
/// @throws InvalidParameter  a negative count
Cloud cloud_of_faces(const ControlMesh& mesh, Index count, unsigned seed = 1);

}  // namespace sublimit
