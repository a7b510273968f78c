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

}  // namespace sublimit
