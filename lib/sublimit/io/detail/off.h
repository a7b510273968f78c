// SPDX-License-Identifier: Apache-2.0
#pragma once
// Object File Format (Geomview): text, `OFF`, its counts, then a line for each vertex and each face. The variants COFF,
// NOFF, STOFF and their mixtures are read, for their positions; colours, normals and texture coordinates are dropped.
#include <filesystem>
#include <string_view>

#include "sublimit/mesh/mesh.h"

namespace sublimit {

/// Reads the mesh of a file; OFF has no tags.
/// @throws FormatError  not text, not OFF, counts that the file is too short for
/// @throws InvalidMesh  indices out of range, faces of fewer than 3 corners, infinite coordinates
/// @throws IoError      missing, unreadable;  ResourceError  more than memory or 32-bit indices hold
Mesh read_off(const std::filesystem::path& path);
/// Reads a mesh from the text of an OFF file.
/// @param name  name of the text, with which messages start
/// @throws as `read_off`, but for IoError
Mesh parse_off(std::string_view text, std::string_view name);

}  // namespace sublimit
