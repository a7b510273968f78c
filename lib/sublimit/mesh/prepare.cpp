// SPDX-License-Identifier: Apache-2.0
#include "sublimit/mesh/prepare.h"

#include "sublimit/mesh/sharpness.h"

namespace sublimit {

ControlMesh triangulated(const ControlMesh& mesh) {
  const Topology t(view(mesh));
  const std::vector<bool> holes = initial_holes(t, mesh, Boundary::edge_only);
  ControlMesh result = mesh;
  result.face_sizes.clear();
  result.face_vertices.clear();
  result.holes.clear();
  for (Index f = 0; f < t.num_faces(); ++f) {
    const std::span<const Index> corners = t.vertices(Face{f});
    for (size_t i = 1; i + 1 < corners.size(); ++i) {
      if (holes[f]) result.holes.push_back(result.num_faces());
      result.face_sizes.push_back(3);
      result.face_vertices.insert(result.face_vertices.end(), {corners[0], corners[i], corners[i + 1]});
    }
  }
  return result;
}

ControlMesh without_creases(ControlMesh mesh) {
  mesh.creases.clear();
  mesh.corners.clear();
  return mesh;
}

}  // namespace sublimit
