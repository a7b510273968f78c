// SPDX-License-Identifier: Apache-2.0
#pragma once
// Control meshes made acceptable for schemes that take triangles only, or that have no rule for creases.
#include "sublimit/mesh/mesh.h"

namespace sublimit {

/// Every face cut into triangles, a fan from its first corner: corners (0, i, i + 1) for i = 1 ... n - 2, in the face's
/// place. Vertices, values, creases, corners and options stay; the triangles of a hole are holes, those
/// of a face have its name.
/// @throws InvalidMesh  connectivity that no scheme takes, a hole that names no face, a channel or names of another
/// size
/// @note  Where a diagonal runs along an edge of other faces, that edge becomes non-manifold.
Mesh triangulated(const Mesh& mesh);

/// The mesh without its creases and corners. Boundaries stay what they are.
Mesh without_creases(Mesh mesh);

}  // namespace sublimit
