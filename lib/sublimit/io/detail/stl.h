// SPDX-License-Identifier: Apache-2.0
#pragma once
// Stereolithography files (STL): triangles, each with the coordinates of its corners, in text or binary.
//
// Read: corners of equal coordinates are one vertex; triangles with two equal corners are left out, with a warning;
// names of solids in text are names of objects. Normals are skipped, and so are the two bytes of a binary triangle in
// which some programs keep a colour. A file of 84 + 50 n bytes for its n triangles is binary, whatever it begins with.
// Written: binary, polygons cut into triangles that do not leave them (face_triangles.h).
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "sublimit/mesh/mesh.h"

namespace sublimit {

/// Reads the mesh of a file; STL has no tags.
/// @throws FormatError  not STL, a file that is too short for its triangles; the place is file:line in text
/// @throws InvalidMesh  no triangles, infinite coordinates
/// @throws IoError      missing, unreadable;  ResourceError  more than memory or 32-bit indices hold
Mesh read_stl(const std::filesystem::path& path);
/// Reads a mesh from the bytes of an STL file.
/// @param name  name of the file, with which messages start
/// @throws as `read_stl`, but for IoError
Mesh parse_stl(std::string_view bytes, std::string_view name);
/// Returns true if bytes are a binary STL file by their number.
bool is_binary_stl(std::string_view bytes);

/// Returns the triangles of a mesh as the bytes of a binary file.
/// @throws InvalidParameter  arrays that do not fit together
/// @throws InvalidMesh       coordinates that are not finite, or beyond floats
/// @throws ResourceError     more triangles than the file can count
std::string format_stl(const Mesh& mesh);
/// Returns what a file changes of a mesh: different points that are one in 32 bits. A sentence each; empty if nothing.
std::vector<std::string> changes_in_stl(const Mesh& mesh);
/// Writes the triangles of a mesh to a binary file, which appears whole or not at all.
void write_stl(const std::filesystem::path& path, const Mesh& mesh,
               const std::function<void(std::int64_t)>& progress = {});

}  // namespace sublimit
