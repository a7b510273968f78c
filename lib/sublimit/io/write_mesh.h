// SPDX-License-Identifier: Apache-2.0
#pragma once
// Writes meshes to .obj, .ply, .off, .stl, .glb, .gltf, .usda and .usdz files.
//
//   write_mesh("fine.obj", refine(read_mesh("coarse.obj"), "loop", 2));
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>

#include "sublimit/mesh/mesh.h"

namespace sublimit {

/// Writes .obj, .ply, .off, .stl, .glb, .gltf, .usda or .usdz, by the extension of `path` in either case. The file
/// appears whole or not at all.
///
/// OBJ holds tags, names of faces, the first face-varying channel as `vt` of 1 to 3 columns, and normals, which
/// are left out at faces that lack one at a corner. PLY holds texture coordinates and normals of vertices, numbers of
/// faces, values of both in their types, and the first face-varying channel if it has 2 columns, as floats. OFF holds
/// colours. STL holds triangles alone, as floats: polygons are cut into fans.
///
/// glTF holds triangles as floats, in a node for each object and a primitive for each material; normals, texture
/// coordinates, colours and values of vertices, which are split where corners differ. Polygons are cut into triangles
/// within the face and marked as parts of it (FB_ngon_encoding), so that `read_mesh` makes faces of them again; other
/// programs show triangles. Colours are written as they are; glTF takes them for linear ones, cut off at 0 and 1.
/// @param progress  called with the number of bytes written so far, if given
/// @throws InvalidOption     another extension
/// @throws InvalidMesh       faces and tags that `refine` refuses, in the same words; coordinates that are not finite
/// @throws InvalidParameter  further arrays that do not fit together, or normals per corner in a .ply
/// @throws IoError           a file that cannot be written
/// @throws ResourceError     a full disk
/// @note  Rows are formatted by all threads: the same bytes for any number of them.
void write_mesh(const std::filesystem::path& path, const Mesh& mesh,
                const std::function<void(std::int64_t)>& progress = {});

/// Throws unless `write_mesh` would accept a mesh; for writers of other formats.
/// @param name  name of the file, with which messages start
/// @throws InvalidParameter, InvalidMesh  as `write_mesh`
void check_output(const Mesh& mesh, const std::string& name);

}  // namespace sublimit
