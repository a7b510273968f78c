// SPDX-License-Identifier: Apache-2.0
#pragma once
// A refined mesh from another library.
#include <vector>

#include "sublimit/core/types.h"

namespace sublimit::testing {

struct PeerMesh {
  Points positions;
  std::vector<Index> face_sizes, face_vertices;  ///< counter-clockwise
  Index num_edges = 0;                           ///< as the library counts them
};

}  // namespace sublimit::testing
