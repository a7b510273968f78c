// SPDX-License-Identifier: Apache-2.0
#pragma once
// Object File Format (Geomview): text, `OFF`, its counts, then vertices and faces, free of line ends. The variants
// COFF, NOFF, STOFF and their mixtures have colours, normals and texture coordinates behind the coordinates of
// vertices, in the order normals, colours, texture coordinates. Numbers on the line of a face's last corner are its
// colour; where the file has too few numbers for that, they are further faces.
//
// Colours are kept, as `vertex_values` and `face_values` of the names red, green, blue and alpha: 0 to 255 if a number
// above 1 is among them, otherwise 0 to 1. Texture coordinates are `vertex_values` s and t,
// as those of a PLY file are. Normals are dropped, with a note.
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

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

/// Returns a mesh as the text of a file: COFF if its vertices have colours.
/// @throws InvalidParameter  arrays that do not fit together
/// @throws InvalidMesh       coordinates that are not finite
std::string format_off(const Mesh& mesh);
/// Writes a mesh to a file, which appears whole or not at all.
void write_off(const std::filesystem::path& path, const Mesh& mesh,
               const std::function<void(std::int64_t)>& progress = {});

/// Returns what a file changes of a mesh: colours beyond 0 to 1 are cut off. A sentence each; empty if nothing.
std::vector<std::string> changes_in_off(const Mesh& mesh);

/// The first word of a file, such as `STCNOFF`.
struct OffKeyword {
  bool texture = false, colours = false, normals = false;
  bool other_dimension = false;  ///< `4OFF`, `nOFF`: points of other than 3 dimensions
  std::string_view count = {};   ///< the number of vertices, if it is glued to the word: `OFF8`
};
/// Returns the parts of a keyword; absent if the word is none.
std::optional<OffKeyword> parse_off_keyword(std::string_view word);

}  // namespace sublimit
