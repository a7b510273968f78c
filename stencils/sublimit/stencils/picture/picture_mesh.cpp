// SPDX-License-Identifier: Apache-2.0
#include "sublimit/stencils/picture/picture_mesh.h"

namespace sublimit {

PictureMesh wire_picture(const Level& level, const Points& points) {
  const Topology& t = level.topology();
  PictureMesh picture;
  picture.positions = points;
  picture.wireframe = true;
  for (Index f = 0; f < t.num_faces(); ++f) {
    const auto corners = t.vertices(Face{f});
    picture.face_sizes.push_back(t.size(Face{f}));
    picture.face_vertices.insert(picture.face_vertices.end(), corners.begin(), corners.end());
  }
  for (Index e = 0; e < t.num_edges(); ++e) {
    const float s = level.sharpness.edge[e];
    if (!is_sharp(s) || t.is_boundary(Edge{e})) continue;
    picture.creases.push_back({index(t.tail(Edge{e})), index(t.head(Edge{e})), is_infinite(s) ? 1 : s / 5.0});
  }
  return picture;
}

PictureMesh surface_picture(const Mesh& surface) {
  PictureMesh picture;
  picture.positions = surface.positions;
  picture.face_sizes = surface.face_sizes;
  picture.face_vertices = surface.face_vertices;
  picture.corner_normals = Points::Zero(Index(surface.face_normals.size()), 3);
  for (size_t c = 0; c < surface.face_normals.size(); ++c)
    if (surface.face_normals[c] >= 0)
      picture.corner_normals.row(Index(c)) = surface.normals.row(surface.face_normals[c]);
  return picture;
}

}  // namespace sublimit
