// SPDX-License-Identifier: Apache-2.0
#pragma once
// Conversion of control meshes for schemes that accept only triangles, or have no rule for creases.
#include "sublimit/mesh/mesh.h"

namespace sublimit {

/// Returns the mesh with every face cut into a fan of triangles from its first corner: corners (0, i, i + 1)
/// for i = 1 ... n - 2, in the order of faces. Vertices, values, creases, corners and options are kept;
/// triangles of a hole are holes, and those of a face have its name.
/// @throws InvalidMesh  unsupported connectivity, a hole that names no face, a channel or names of another size
/// @note  If a diagonal coincides with an edge of other faces, this edge becomes non-manifold.
Mesh triangulated(const Mesh& mesh);

/// Returns the mesh without its creases and corners. Boundaries do not change.
Mesh without_creases(Mesh mesh);

}  // namespace sublimit
