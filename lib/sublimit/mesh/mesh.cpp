// SPDX-License-Identifier: Apache-2.0
#include "sublimit/mesh/mesh.h"

#include <string>

#include "sublimit/base/error.h"

namespace sublimit {

Mesh Mesh::with_points(Points points) const {
  if (points.rows() != num_vertices() || points.cols() != 3)
    throw InvalidParameter("points are " + std::to_string(points.rows()) + " x " + std::to_string(points.cols()) +
                           "; " + std::to_string(num_vertices()) + " x 3 are right");
  Mesh mesh = *this;
  mesh.positions.swap(points);
  return mesh;
}

Mesh::FaceNames Mesh::face_names() const {
  if (groups.of_face.empty()) return objects;
  FaceNames result = groups;
  std::vector<Index> number(objects.names.size(), -1);  // of an object in `result`
  for (size_t f = 0; f < result.of_face.size() && f < objects.of_face.size(); ++f) {
    const Index object = objects.of_face[f];
    if (result.of_face[f] >= 0 || object < 0) continue;
    Index& known = number[static_cast<size_t>(object)];
    const std::string& name = objects.names[static_cast<size_t>(object)];
    for (size_t i = 0; i < groups.names.size() && known < 0; ++i)
      if (groups.names[i] == name) known = static_cast<Index>(i);
    if (known < 0) {
      known = static_cast<Index>(result.names.size());
      result.names.push_back(name);
    }
    result.of_face[f] = known;
  }
  return result;
}

}  // namespace sublimit
