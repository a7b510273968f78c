// SPDX-License-Identifier: Apache-2.0
#pragma once
// Face-varying channels on a tessellation. A channel is a surface of its own with the same faces
// (primvar/face_varying.h); its seams are borders, so corners of triangles at the same point share a value only
// if no seam separates them.
#include <vector>

#include "sublimit/tessellation/tessellate.h"

namespace sublimit {

/// Values of a channel at corners of triangles.
struct CornerValues {
  std::vector<Place> places;   ///< place of each value
  std::vector<Index> indices;  ///< index of the value at each corner, three per triangle
};

/// Returns the values of a channel.
/// @param channel  surface of the channel, with the same faces
CornerValues corner_values(const Tessellation& made, const LimitMap& channel);

}  // namespace sublimit
