// SPDX-License-Identifier: Apache-2.0
#pragma once
// Reads a mesh from any file format that is known.
#include <filesystem>

#include "sublimit/mesh/control_mesh.h"

namespace sublimit {

/// Reads .obj (with tags), .ply or .off, by the extension of `path` in either case.
/// @throws FormatError    another extension, or what the format's reader throws (obj.h)
/// @throws InvalidMesh    see obj.h;  IoError  missing, a directory, unreadable;  ResourceError  too large
ControlMesh read_mesh(const std::filesystem::path& path);

}  // namespace sublimit
