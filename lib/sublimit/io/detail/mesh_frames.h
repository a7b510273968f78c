// SPDX-License-Identifier: Apache-2.0
#pragma once
// Animations in files of meshes: the faces are the same in all frames.
#include <cstdint>
#include <functional>

#include "sublimit/core/types.h"

namespace sublimit {

struct MeshFrames {
  std::int64_t count = 1;
  std::function<Points(std::int64_t)> positions;  ///< of a frame, #V x 3
};

}  // namespace sublimit
