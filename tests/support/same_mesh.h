// SPDX-License-Identifier: Apache-2.0
#pragma once
// Meshes that are the same but for the order of their points and faces.
#include <string>

#include "sublimit/mesh/mesh.h"

namespace sublimit::testing {

/// What differs in points, faces, texture coordinates of the first channel, creases and corners; empty: nothing does.
/// Points are matched by where they are, so no two may be in the same place. Faces may begin at any corner.
/// @param tolerance  of coordinates of points and textures
std::string difference(const Mesh& a, const Mesh& b, double tolerance);

}  // namespace sublimit::testing
