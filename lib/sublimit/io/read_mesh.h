// SPDX-License-Identifier: Apache-2.0
#pragma once
// Reads meshes from .obj, .ply, .off and .stl files.
//
//   const Mesh mesh = read_mesh("torus.obj");
//   std::cout << mesh.num_vertices() << " vertices, " << mesh.num_faces() << " faces\n";
//   for (const std::string& warning : mesh.warnings) std::cerr << warning << "\n";
#include <filesystem>

#include "sublimit/mesh/mesh.h"

namespace sublimit {

/// Reads .obj (with tags), .ply, .off or .stl, by the extension of `path` in either case. Files that gzip compressed
/// are inflated, whatever their names are; `mesh.obj.gz` is read as `mesh.obj` is.
/// @throws FormatError    another extension, or a line that cannot be understood: says which, and what would be right
/// @throws InvalidMesh    indices out of range, numbers that are not finite, a file without a mesh
/// @throws IoError        a file that is missing, a directory, or cannot be read
/// @throws ResourceError  a mesh larger than memory or 32-bit indices hold
Mesh read_mesh(const std::filesystem::path& path);

}  // namespace sublimit
