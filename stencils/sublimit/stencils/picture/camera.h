// SPDX-License-Identifier: Apache-2.0
#pragma once
// One camera for all panels: their contents are scaled to a box of half-width 1, projected in perspective, and
// fitted to the panel.
#include <Eigen/Core>

#include <vector>

#include "sublimit/stencils/picture/picture.h"

namespace sublimit::picture {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// The box that is shown: its centre, and half of its largest side. Computed without overflow for huge
/// coordinates.
struct Frame {
  Vector3d half_center = Vector3d::Zero();
  double half_size = 1;
  Vector3d local(const Vector3d& p) const { return (p / 2 - half_center) / (half_size / 2); }
};

/// Returns the frame of all points of faces, lines and dots, and of `PictureOptions::in_view`.
Frame frame_of(const std::vector<Panel>& panels, const PictureOptions& options);

/// A projected point: pixels, y down, and a nearness that is linear on the screen, for the depth buffer.
struct Projected {
  double x = 0, y = 0, near = 0;
};

struct Camera {
  Eigen::Matrix3d axes;  // rows: right, up, towards the eye
  Vector3d up;
  double distance;   // 0: orthographic
  double scale = 1;  // pixels per unit at the centre
  Vector2d shift = Vector2d::Zero();

  explicit Camera(const PictureOptions& options);
  Vector3d seen(const Vector3d& p) const { return axes * p; }
  Projected project(const Vector3d& v) const {
    const double ratio = distance > 0 ? distance / (distance - v.z()) : 1;
    return {scale * ratio * v.x() + shift.x(), -scale * ratio * v.y() + shift.y(),
            distance > 0 ? distance * ratio : v.z()};
  }
  /// Returns true if the outside of a plane with this normal at this point faces the eye; both are in camera
  /// coordinates.
  bool faces_eye(const Vector3d& normal, const Vector3d& point) const {
    return distance > 0 ? normal.dot(Vector3d(0, 0, distance) - point) > 0 : normal.z() > 0;
  }
};

/// Sets the camera's scale and shift so that all panels fit, with a margin.
void fit(Camera& camera, const std::vector<Panel>& panels, const Frame& frame, const PictureOptions& options);

}  // namespace sublimit::picture
