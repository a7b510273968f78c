// SPDX-License-Identifier: Apache-2.0
#pragma once
// Reads meshes from .obj, .ply, .off, .stl, .glb, .gltf, .usda and .usdz files.
//
//   const Mesh mesh = read_mesh("torus.obj");
//   std::cout << mesh.num_vertices() << " vertices, " << mesh.num_faces() << " faces\n";
//   for (const std::string& warning : mesh.warnings) std::cerr << warning << "\n";
#include <filesystem>

#include "sublimit/mesh/mesh.h"

namespace sublimit {

/// Reads .obj (with tags), .ply, .off, .stl, .glb, .gltf, .usda or .usdz, by the extension of `path` in either case.
/// Files that gzip compressed are inflated, whatever their names are; `mesh.obj.gz` is read as `mesh.obj` is.
///
/// Reads of glTF the triangles of the scene, where its nodes put them. Vertices of a mesh that have equal
/// coordinates are one vertex, so that surfaces are closed where normals or texture coordinates differ. Names of nodes
/// are `objects`, those of materials `materials`; texture coordinates are of corners, with t from the lower edge;
/// colours stay as they are in the file, which are linear ones. What is left out is told in `warnings` and `notes`.
/// @throws FormatError    another extension, or a line that cannot be understood: says which, and what would be right
/// @throws InvalidMesh    indices out of range, numbers that are not finite, a file without a mesh
/// @throws IoError        a file that is missing, a directory, or cannot be read
/// @throws ResourceError  a mesh larger than memory or 32-bit indices hold
Mesh read_mesh(const std::filesystem::path& path);

}  // namespace sublimit
