// SPDX-License-Identifier: Apache-2.0
#include "sublimit/stencils/picture/panel.h"

#include <cmath>

#include "sublimit/stencils/picture/light.h"

namespace sublimit::picture {

SeenPanel::SeenPanel(const Panel& shown, const Frame& frame, const Camera& by, const PictureOptions& options)
    : panel(shown),
      camera(by),
      tone_step(options.tone_step),
      scene(scene_of(shown, frame, by)),
      buffer(static_cast<int>(std::ceil(options.panel_width * supersampling)),
             static_cast<int>(std::ceil(options.panel_height * supersampling))) {
  light_scene(scene, camera, options.sky_directions);
  for (const Vector3d& p : scene.points) at.push_back(camera.project(p));
  for (int f = 0; f < static_cast<int>(scene.faces.size()); ++f) {
    if (!scene.faces[f].solid) continue;
    triangles(scene.faces[f],
              [&](const Projected& a, const Projected& b, const Projected& c) { buffer.draw(a, b, c, f); });
  }
}

}  // namespace sublimit::picture
