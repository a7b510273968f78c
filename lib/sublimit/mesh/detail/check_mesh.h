// SPDX-License-Identifier: Apache-2.0
#pragma once
// Common checks of mesh readers and writers, so that they report the same errors.
#include "sublimit/mesh/mesh.h"
#include "sublimit/mesh/mesh_view.h"

namespace sublimit {

/// Checks that faces have three corners or more, each at a vertex of the mesh.
/// @throws InvalidMesh    names the face or corner;  ResourceError  more corners than 32-bit indices count
void check_faces(const MeshView& mesh);

/// Checks that creases, corners and holes name vertices and faces of the mesh, and that no sharpness is negative.
/// Creases along edges are checked by `initial_sharpness`.
/// @throws InvalidMesh  names the tag
void check_tags(const Mesh& mesh);

}  // namespace sublimit
