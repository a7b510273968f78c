// SPDX-License-Identifier: Apache-2.0
#pragma once
// Normals of the vertices of an OBJ file, `vn x y z` with the third index of the corners of `f`, for readers
// that need them (read_obj skips them). All corners at a vertex must agree.
#include <filesystem>
#include <string_view>

#include "sublimit/core/types.h"

namespace sublimit {

/// Returns the normal of each vertex as in the file, of any length.
/// @return  #v x 3; zero at vertices without a face; no rows if the file has neither `vn` nor corners that name one
/// @throws FormatError  malformed numbers or index 0; names file:line
/// @throws InvalidMesh  numbers that are not finite, indices out of range; `vn` that no corner names; a corner
///                      without a normal, or with another one than an earlier corner of its vertex has: file:line
///                      and vertex
/// @throws IoError      missing, unreadable;  ResourceError  more than memory or 32-bit indices hold
Points read_obj_normals(const std::filesystem::path& path);

/// Reads normals from the text of an OBJ file.
/// @param name  name of the text, with which messages start
/// @throws as `read_obj_normals`, but for IoError
Points parse_obj_normals(std::string_view text, std::string_view name);

}  // namespace sublimit
