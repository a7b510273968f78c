// SPDX-License-Identifier: Apache-2.0
#pragma once
// glTF 2.0: scenes of meshes, in one binary file (.glb) or as JSON with buffers inside or in files beside it (.gltf).
//
// Read: triangles, strips and fans of the scene, moved by the transforms of their nodes. Names of nodes, or else of
// meshes, are names of objects. Vertices of one mesh with equal coordinates are one vertex. TEXCOORD_0 are texture
// coordinates of corners (t of glTF starts at the upper edge: 1 - t), COLOR_0 colours of vertices as they are in the
// file, without a change of colour space, and numbers `_NAME` values at vertices. Triangles that the extension
// FB_ngon_encoding marks as parts of a polygon are one face again. Normals are skipped: a control mesh's normals are
// not those of its surface. What else a file has is told in `Mesh::warnings`.
// Written: a node with a mesh for each object, a primitive for each material, floats of 32 bits. Polygons are cut into
// triangles, which FB_ngon_encoding marks. Coordinates of a mesh far from the origin are relative to its middle, which
// becomes the node's translation. Axes are not changed; glTF expects y up.
//
// tinygltf is not used: it needs three times the memory of the file, and does not rename a temporary file at the end.
// Source: The Khronos Group, glTF 2.0 specification.
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "sublimit/mesh/mesh.h"

namespace sublimit {

/// Reads the meshes of a file's scene as one mesh. Its first bytes tell .glb from .gltf.
/// @throws FormatError    not glTF 2.0, sizes that do not fit together, required extensions that cannot be read
/// @throws InvalidMesh    no triangles, indices out of range, coordinates that are not finite
/// @throws IoError        a file that is missing or cannot be read, also one beside the file
/// @throws ResourceError  more than memory or 32-bit indices hold
Mesh read_gltf(const std::filesystem::path& path);
/// Reads a mesh from the bytes of a file.
/// @param name    name of the file, with which messages start
/// @param folder  where files beside it are; empty: there are none
/// @throws as `read_gltf`
Mesh parse_gltf(std::string_view bytes, std::string_view name, const std::filesystem::path& folder = {});
/// Returns true if text begins as the JSON of a glTF file does.
bool begins_gltf(std::string_view text);

/// Returns what a file changes of a mesh beside the precision of its numbers, a sentence each.
std::vector<std::string> changes_in_gltf(const Mesh& mesh);
/// Returns a mesh as the bytes of a .glb file.
/// @throws InvalidParameter  arrays that do not fit together
/// @throws InvalidMesh       numbers that are not finite, or beyond floats
/// @throws ResourceError     4 GB or more, the limit of the format
std::string format_glb(const Mesh& mesh);
/// Writes a mesh to a .glb file, which appears whole or not at all.
/// @throws as `format_glb`; IoError, ResourceError  a file that cannot be written, a full disk
void write_glb(const std::filesystem::path& path, const Mesh& mesh,
               const std::function<void(std::int64_t)>& progress = {});
/// Writes the same as JSON, with its buffer inside.
void write_gltf(const std::filesystem::path& path, const Mesh& mesh,
                const std::function<void(std::int64_t)>& progress = {});

}  // namespace sublimit
