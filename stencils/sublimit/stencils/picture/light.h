// SPDX-License-Identifier: Apache-2.0
#pragma once
// Light: the tone of every corner, from the part of the sky that its face sees, a key light, a fill light and a
// highlight.
#include "sublimit/stencils/picture/scene.h"

namespace sublimit::picture {

constexpr int tones = 112;  ///< steps of a colour ramp; fewer would show as bands

/// Sets `tone` of every face and corner.
void light_scene(Scene& scene, const Camera& camera, int sky_directions);

}  // namespace sublimit::picture
