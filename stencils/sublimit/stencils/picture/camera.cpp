// SPDX-License-Identifier: Apache-2.0
#include "sublimit/stencils/picture/camera.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>

namespace sublimit::picture {

namespace {

/// Calls use(point) for everything that is shown.
template <class Use>
void for_each_point(const std::vector<Panel>& panels, const PictureOptions& options, const Use& use) {
  for (const Panel& panel : panels) {
    for (const PictureMesh& mesh : panel.layers) {
      const auto add = [&](Index v) { use(Vector3d(mesh.positions.row(v))); };
      for (Index v : mesh.face_vertices) add(v);
      for (const PictureMesh::Line& line : mesh.creases) add(line.tail), add(line.head);
      for (Index v : mesh.dots) add(v);
    }
  }
  for (Eigen::Index i = 0; i < options.in_view.rows(); ++i) use(Vector3d(options.in_view.row(i)));
}

}  // namespace

Frame frame_of(const std::vector<Panel>& panels, const PictureOptions& options) {
  Vector3d low = Vector3d::Constant(std::numeric_limits<double>::infinity()), high = -low;
  for_each_point(panels, options, [&](const Vector3d& p) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  });
  Frame frame;
  if (!(low.x() <= high.x())) return frame;  // nothing to show
  frame.half_center = low / 4 + high / 4;
  const double size = (high / 2 - low / 2).maxCoeff();
  if (size > 0) frame.half_size = size;
  return frame;
}

Camera::Camera(const PictureOptions& o) : up(o.up.normalized()), distance(o.distance * std::sqrt(3.)) {
  const Vector3d x = std::abs(up.x()) < .9 ? Vector3d::UnitX() : Vector3d::UnitZ();
  const Vector3d front = x.cross(up).normalized(), side = up.cross(front);
  const double elevation = std::clamp(o.elevation, -1.55, 1.55);
  const Vector3d eye =
      std::cos(elevation) * (std::cos(o.azimuth) * front + std::sin(o.azimuth) * side) + std::sin(elevation) * up;
  axes.row(2) = eye;
  axes.row(0) = up.cross(eye).normalized();
  axes.row(1) = eye.cross(Vector3d(axes.row(0)));
}

void fit(Camera& camera, const std::vector<Panel>& panels, const Frame& frame, const PictureOptions& options) {
  Vector2d low = Vector2d::Constant(std::numeric_limits<double>::infinity()), high = -low;
  for_each_point(panels, options, [&](const Vector3d& point) {
    const Projected p = camera.project(camera.seen(frame.local(point)));
    low = low.cwiseMin(Vector2d(p.x, p.y));
    high = high.cwiseMax(Vector2d(p.x, p.y));
  });
  const Vector2d size(options.panel_width, options.panel_height);
  const double margin = .06 * size.minCoeff();
  if (!(low.x() <= high.x())) return;
  const Vector2d extent = (high - low).cwiseMax(1e-3);
  camera.scale = ((size.array() - 2 * margin) / extent.array()).minCoeff();
  camera.shift = size / 2 - camera.scale * (low + high) / 2;
}

}  // namespace sublimit::picture
