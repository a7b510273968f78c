// SPDX-License-Identifier: Apache-2.0
#pragma once
// Point clouds: points without order that a surface should be near to, as `fit_cloud` takes them.
//
//   const Mesh scan = read_mesh("scan.ply");
//   const Cloud vertices = cloud_of_vertices(scan);
//   const Cloud spread = cloud_of_faces(scan, 10000);
//   const Cloud measured = {.points = scan.positions};  // all of weight 1
#include <vector>

#include "sublimit/mesh/mesh.h"

namespace sublimit {

/// A point cloud. Plain data.
struct Cloud {
  Points points;                     ///< #points x 3
  std::vector<double> weights = {};  ///< weights of the squared distances, >= 0; empty: all 1
};

/// Returns the vertices of a mesh that belong to faces, each weighted by its share of their area: a third of every
/// triangle, polygons cut into triangles from their first corner.
/// @throws InvalidMesh  a position that is not finite, a corner that is no vertex
Cloud cloud_of_vertices(const Mesh& mesh);

/// Returns random points on the faces of a mesh, uniformly distributed by area, of equal weight. Equal seeds give equal
/// points.
/// @throws InvalidMesh       a position that is not finite, a corner that is no vertex, faces without any area
/// @throws InvalidParameter  a negative count
Cloud cloud_of_faces(const Mesh& mesh, Index count, unsigned seed = 1);

}  // namespace sublimit
