// SPDX-License-Identifier: Apache-2.0
#pragma once
// A soft spot on the ground below what stands there: an ellipse with a gradient, the only thing that is not sharp.
#include <string>

#include "sublimit/stencils/picture/camera.h"

namespace sublimit::picture {

/// The ellipse; nothing for a panel without faces. It is filled with the gradient `shadow`.
std::string ground_shadow(const Panel& panel, const Frame& frame, const Camera& camera);

}  // namespace sublimit::picture
