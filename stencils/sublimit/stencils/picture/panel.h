// SPDX-License-Identifier: Apache-2.0
#pragma once
// A panel as the camera sees it: its scene, the projected points, and the depth buffer. Faces are drawn first,
// then the lines and dots of every layer.
#include <string>
#include <vector>

#include "sublimit/stencils/picture/depth_buffer.h"
#include "sublimit/stencils/picture/scene.h"
#include "sublimit/stencils/picture/svg.h"

namespace sublimit::picture {

constexpr int supersampling = 5;  ///< depth samples per pixel and direction

struct SeenPanel {
  SeenPanel(const Panel& panel, const Frame& frame, const Camera& camera, const PictureOptions& options);

  /// Calls `use` for the triangles of a face, in samples of the depth buffer.
  template <class Use>
  void triangles(const SceneFace& face, Use use) const {
    const auto fine = [](Projected p) { return Projected{p.x * supersampling, p.y * supersampling, p.near}; };
    for_each_triangle(
        scene, face, at, camera.project(face.center),
        [&](const Projected& a, const Projected& b, const Projected& c) { use(fine(a), fine(b), fine(c)); });
  }

  const Panel& panel;
  const Camera& camera;
  int tone_step;
  Scene scene;
  DepthBuffer buffer;
  std::vector<Projected> at;  ///< projections of the scene's points
};

inline svg::Spot spot(const Projected& p) { return svg::spot(p.x, p.y); }

/// Appends the faces of all layers to the text of an SVG group.
void write_faces(std::string& svg, const SeenPanel& seen);
/// Appends the wire, creases and dots of a layer.
void write_lines(std::string& svg, const SeenPanel& seen, int layer);

}  // namespace sublimit::picture
