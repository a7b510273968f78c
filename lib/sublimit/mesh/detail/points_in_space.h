// SPDX-License-Identifier: Apache-2.0
#pragma once
// Control points of a mesh, checked for limits.
#include "sublimit/mesh/mesh.h"

namespace sublimit {

/// Returns the positions of a mesh, #V x 3; of a mesh without vertices 0 x 3.
/// @throws InvalidMesh  another number of columns; a coordinate that is not finite: says of which control point
Points points_in_space(const Mesh& mesh);

}  // namespace sublimit
