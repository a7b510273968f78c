// SPDX-License-Identifier: Apache-2.0
#pragma once
// Triangles as binary glTF 2.0 (`.glb`): one node with one mesh, POSITION, NORMAL and TEXCOORD_0 in float, indices of
// 32 bits. Axes are not changed; glTF expects y up. Coordinates of a mesh far from the origin are relative to
// its middle, which becomes the node's translation. Texture coordinates of glTF start at the upper edge: t
// becomes 1 - t.
//
// tinygltf is not used for writing: it needs three times the memory of the file, and does not rename a
// temporary file at the end. Source: The Khronos Group, glTF 2.0 specification, 3.6 and 4.
#include <filesystem>
#include <functional>

#include "sublimit/io/write_mesh.h"

namespace sublimit {

/// Writes a mesh of triangles.
/// @param mesh  may have unit normals and `texture`, both per vertex. Tags are left out
/// @throws InvalidParameter  other faces, values per corner
/// @throws InvalidMesh       coordinates that are not finite as floats
/// @throws ResourceError     4 GB or more, the limit of the format; a full disk
/// @throws IoError           unwritable
void write_glb(const std::filesystem::path& path, const Mesh& mesh,
               const std::function<void(std::int64_t)>& progress = {});

}  // namespace sublimit
