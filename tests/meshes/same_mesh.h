// SPDX-License-Identifier: Apache-2.0
#pragma once
// Comparison of meshes up to the order of their points and faces.
#include <string>

#include "sublimit/mesh/mesh.h"

namespace sublimit::testing {

/// Returns a difference in points, faces, texture coordinates of the first channel, creases or corners; empty
/// if there is none. Points are matched by their positions, so no two may coincide. Faces may start at any
/// corner.
/// @param tolerance  tolerance of coordinates of points and textures
std::string difference(const Mesh& a, const Mesh& b, double tolerance);

}  // namespace sublimit::testing
