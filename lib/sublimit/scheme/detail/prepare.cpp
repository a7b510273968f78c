// SPDX-License-Identifier: Apache-2.0
#include "sublimit/scheme/detail/prepare.h"

#include <string>

#include "sublimit/base/error.h"
#include "sublimit/mesh/detail/attributes.h"
#include "sublimit/mesh/sharpness.h"

namespace sublimit {

Mesh triangulated(const Mesh& mesh) {
  const Topology t(view(mesh));
  const std::vector<bool> holes = initial_holes(t, mesh, Boundary::edge_only);
  Mesh result = mesh;
  result.face_sizes.clear();
  result.face_vertices.clear();
  result.holes.clear();
  result.knot_intervals.clear();  // of strips of quadrilaterals
  for (Mesh::FaceVarying& channel : result.face_varying) {
    if (channel.indices.size() != mesh.face_vertices.size())
      throw InvalidMesh("face-varying channel '" + channel.name + "' has " + std::to_string(channel.indices.size()) +
                        " indices; it should have one for each of the " + std::to_string(mesh.face_vertices.size()) +
                        " corners");
    channel.indices.clear();
  }
  std::vector<Index> parents;
  for (Index f = 0; f < t.num_faces(); ++f) {
    const std::span<const Index> corners = t.vertices(Face{f});
    for (size_t i = 1; i + 1 < corners.size(); ++i) {
      if (holes[f]) result.holes.push_back(result.num_faces());
      parents.push_back(f);
      result.face_sizes.push_back(3);
      result.face_vertices.insert(result.face_vertices.end(), {corners[0], corners[i], corners[i + 1]});
      for (size_t c = 0; c < mesh.face_varying.size(); ++c) {
        const Index* const values = mesh.face_varying[c].indices.data() + index(t.first(Face{f}));
        std::vector<Index>& indices = result.face_varying[c].indices;
        indices.insert(indices.end(), {values[0], values[i], values[i + 1]});
      }
    }
  }
  carry_faces(mesh, parents, result);
  return result;
}

Mesh without_creases(Mesh mesh) {
  mesh.creases.clear();
  mesh.corners.clear();
  return mesh;
}

}  // namespace sublimit
