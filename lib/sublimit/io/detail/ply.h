// SPDX-License-Identifier: Apache-2.0
#pragma once
// Polygon File Format (Stanford): text or binary of either byte order, numbers of any type.
//
// Read: `x`, `y`, `z` of the element `vertex` and the list `vertex_index` or `vertex_indices` of the element `face`, or
// of `tristrips` if there are no faces. Further numbers of vertices and faces become `vertex_values` and `face_values`,
// but for normals of vertices; the list `texcoord` of faces becomes a face-varying channel `uv`. Other lists and
// elements are left out, with a warning. Written: binary little-endian, positions as doubles, values in their types,
// integers rounded and as large as their type has them, one normal per vertex, two numbers of the first face-varying
// channel as floats. The format has no tags.
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sublimit/io/write_mesh.h"
#include "sublimit/mesh/mesh.h"

namespace sublimit {

/// Reads the mesh of a file; PLY has no tags.
/// @throws FormatError  not PLY, a header that makes no sense, counts that the file is too short for;
///                      the place is file:line in text, file: byte in binary data
/// @throws InvalidMesh  indices out of range, faces of fewer than 3 corners, infinite coordinates
/// @throws IoError      missing, unreadable;  ResourceError  more than memory or 32-bit indices hold
Mesh read_ply(const std::filesystem::path& path);
/// Reads a mesh from the bytes of a PLY file.
/// @param name  name of the file, with which messages start
/// @throws the errors of `read_ply` except IoError
Mesh parse_ply(std::string_view bytes, std::string_view name);

/// Returns the shape with the named numbers of vertices as its `vertex_values`; those that the file lacks are left
/// out.
Mesh read_ply(const std::filesystem::path& path, std::span<const std::string> names);
Mesh parse_ply(std::string_view bytes, std::string_view name, std::span<const std::string> names);

/// Returns a mesh as the bytes of a file.
///
/// Writes the last of values with the same name; `texture`, `face_ids` and normals take the place of values named
/// `s`, `t`, `face_id`, `nx`, `ny` and `nz`.
/// @throws InvalidParameter  normals per corner, arrays that do not fit together, names that a header cannot have
/// @throws InvalidMesh       coordinates that are not finite, values of integer types that are no number, or texture
///                           coordinates beyond floats
std::string format_ply(const Mesh& mesh);
/// Returns what a file changes of a mesh: values whose name is taken, and those beyond their type. A sentence each;
/// empty if nothing.
std::vector<std::string> changes_in_ply(const Mesh& mesh);
/// Writes a mesh to a file, which appears whole or not at all.
void write_ply(const std::filesystem::path& path, const Mesh& mesh,
               const std::function<void(std::int64_t)>& progress = {});

}  // namespace sublimit
