// SPDX-License-Identifier: Apache-2.0
#pragma once
// One camera for all panels: what is shown, scaled to a box of half-width 1, seen in perspective, fitted to the panel.
#include <Eigen/Core>

#include <vector>

#include "sublimit/stencils/picture/picture.h"

namespace sublimit::picture {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// The box that is shown: centre and half of its largest side. Written so that huge coordinates do not overflow.
struct Frame {
  Vector3d half_center = Vector3d::Zero();
  double half_size = 1;
  Vector3d local(const Vector3d& p) const { return (p / 2 - half_center) / (half_size / 2); }
};

/// The frame of everything that faces, lines and dots use, and of what is to be in view.
Frame frame_of(const std::vector<Panel>& panels, const PictureOptions& options);

/// A point as the depth buffer wants it: pixels, y down, and a nearness that is linear on the screen.
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
  /// Is the outside of a plane with this normal at this point (both seen) towards the eye?
  bool faces_eye(const Vector3d& normal, const Vector3d& point) const {
    return distance > 0 ? normal.dot(Vector3d(0, 0, distance) - point) > 0 : normal.z() > 0;
  }
};

/// Scale and shift with which everything of all panels fits, with a margin.
void fit(Camera& camera, const std::vector<Panel>& panels, const Frame& frame, const PictureOptions& options);

}  // namespace sublimit::picture
