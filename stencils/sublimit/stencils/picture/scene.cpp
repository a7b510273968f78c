// SPDX-License-Identifier: Apache-2.0
#include "sublimit/stencils/picture/scene.h"

#include <Eigen/Geometry>

namespace sublimit::picture {

Scene scene_of(const Panel& panel, const Frame& frame, const Camera& camera) {
  Scene scene;
  for (int l = 0; l < static_cast<int>(panel.layers.size()); ++l) {
    const PictureMesh& mesh = panel.layers[l];
    const int first = static_cast<int>(scene.points.size());
    scene.first_point.push_back(first);
    for (Eigen::Index v = 0; v < mesh.positions.rows(); ++v)
      scene.points.push_back(camera.seen(frame.local(mesh.positions.row(v))));
    int corner = 0;
    for (Index size : mesh.face_sizes) {
      SceneFace face;
      face.begin = static_cast<int>(scene.corners.size());
      face.end = face.begin + size;
      face.layer = l;
      face.solid = mesh.faces;
      face.flat = mesh.vertex_normals.size() == 0 && mesh.corner_normals.size() == 0;
      for (int i = 0; i < size; ++i) scene.corners.push_back({.point = first + mesh.face_vertices[corner + i]});
      for (int c = face.begin; c < face.end; ++c) face.center += scene.point(c) / size;
      for (int c = face.begin; c < face.end; ++c) {
        face.normal += (scene.point(c) - face.center).cross(scene.point(scene.next(face, c)) - face.center);
      }
      face.normal.normalize();
      face.back = !camera.faces_eye(face.normal, face.center);
      for (int i = 0; i < size; ++i) {
        Vector3d n = Vector3d::Zero();
        if (mesh.corner_normals.size() > 0) n = mesh.corner_normals.row(corner + i);
        if (n.isZero() && mesh.vertex_normals.size() > 0) n = mesh.vertex_normals.row(mesh.face_vertices[corner + i]);
        n = camera.seen(n.stableNormalized());
        if (!(n.dot(face.normal) > crease_cosine)) n = face.normal;
        scene.corners[face.begin + i].normal = face.back ? Vector3d(-n) : n;
      }
      if (face.back) face.normal = -face.normal;
      corner += size;
      scene.faces.push_back(face);
    }
  }
  return scene;
}

}  // namespace sublimit::picture
