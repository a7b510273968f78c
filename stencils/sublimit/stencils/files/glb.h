// SPDX-License-Identifier: Apache-2.0
#pragma once
// Triangles as binary glTF 2.0 (`.glb`): one node with one mesh, POSITION, NORMAL and TEXCOORD_0 in float, indices of
// 32 bits. Axes are as given: glTF's own up is y. Of a mesh far from the origin coordinates are relative to its middle,
// which is the node's translation. Its texture coordinates begin at the upper edge: t is 1 - t here.
//
// The JSON is nlohmann-json's, which the program has, and numbers stream to the file: tinygltf, the reader in our
// tests, holds a file three times in memory while it writes, and renames nothing. Source: The Khronos Group, glTF 2.0
// specification, 3.6 and 4.
#include <filesystem>
#include <functional>

#include "sublimit/io/write_mesh.h"

namespace sublimit {

/// @param mesh  triangles; normals, all of unit length, and `texture` per vertex, or none. Tags are left out
/// @throws InvalidParameter  other faces, values per corner
/// @throws InvalidMesh       coordinates that are not finite, as floats
/// @throws ResourceError     4 GB or more, the most that the format has, or a full disk;  IoError
void write_glb(const std::filesystem::path& path, const Mesh& mesh,
               const std::function<void(std::int64_t)>& progress = {});

}  // namespace sublimit
