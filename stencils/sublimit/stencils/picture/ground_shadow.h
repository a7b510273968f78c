// SPDX-License-Identifier: Apache-2.0
#pragma once
// A soft shadow on the ground: an ellipse with a gradient.
#include <string>

#include "sublimit/stencils/picture/camera.h"

namespace sublimit::picture {

/// Returns the ellipse, filled with the gradient `shadow`, as SVG; empty for a panel without faces.
std::string ground_shadow(const Panel& panel, const Frame& frame, const Camera& camera);

}  // namespace sublimit::picture
