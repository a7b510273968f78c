// SPDX-License-Identifier: Apache-2.0
#pragma once
// The contents of a panel in camera coordinates: all layers as one list of faces with their corners.
#include <cmath>
#include <numbers>
#include <vector>

#include "sublimit/stencils/picture/camera.h"

namespace sublimit::picture {

/// Cosine of the angle to the face's normal from which a normal belongs to the other side of a crease.
inline const double crease_cosine = std::cos(35 * std::numbers::pi / 180);

struct SceneFace {
  int begin = 0, end = 0;  // corners
  int layer = 0;
  Vector3d center = Vector3d::Zero();
  Vector3d normal = Vector3d::Zero();  // normal of the side that is seen
  bool back = false;                   // true if that side is the inside
  bool solid = true, flat = true;
  double light = 1;  // fraction of the sky that it sees
  double tone = 0;   // at the centre, 0..tones - 1
};

struct SceneCorner {
  int point = 0;
  Vector3d normal = Vector3d::Zero();
  double light = 1;
  double tone = 0;
};

struct Scene {
  std::vector<Vector3d> points;
  std::vector<int> first_point;  // first point of each layer
  std::vector<SceneCorner> corners;
  std::vector<SceneFace> faces;

  const Vector3d& point(int corner) const { return points[corners[corner].point]; }
  static int next(const SceneFace& face, int corner) { return corner + 1 < face.end ? corner + 1 : face.begin; }
};

Scene scene_of(const Panel& panel, const Frame& frame, const Camera& camera);

/// Calls `use` for the triangles of a face: two for a quad, a fan around the centre for more corners.
template <class Use>
void for_each_triangle(const Scene& scene, const SceneFace& face, const std::vector<Projected>& at,
                       const Projected& center, Use use) {
  const int size = face.end - face.begin;
  const auto corner = [&](int i) -> const Projected& { return at[scene.corners[face.begin + i % size].point]; };
  if (size <= 4) {
    for (int i = 1; i + 1 < size; ++i) use(corner(0), corner(i), corner(i + 1));
  } else {
    for (int i = 0; i < size; ++i) use(center, corner(i), corner(i + 1));
  }
}

}  // namespace sublimit::picture
