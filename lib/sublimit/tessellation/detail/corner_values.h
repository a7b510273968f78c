// SPDX-License-Identifier: Apache-2.0
#pragma once
// Face-varying channels on a tessellation. A channel is a surface of its own with the same faces
// (primvar/face_varying.h); its seams are borders, so corners of triangles that are one point of the mesh are one value
// only where no seam is between them.
#include <vector>

#include "sublimit/tessellation/tessellate.h"

namespace sublimit {

struct CornerValues {
  std::vector<Place> places;   ///< of the values
  std::vector<Index> indices;  ///< of the value at each corner of the triangles, three each
};

/// @param channel  a surface of the same faces
CornerValues corner_values(const Tessellation& made, const LimitMap& channel);

}  // namespace sublimit
