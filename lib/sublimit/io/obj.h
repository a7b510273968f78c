// SPDX-License-Identifier: Apache-2.0
#pragma once
// Wavefront OBJ with subdivision tags, read and written to the same bits.
//
// Taken: `v x y z` (what follows, a weight or colours, is dropped), `f` with its vertices as `a`, `a/b`, `a//c` or
// `a/b/c`, negative ones counting backwards, faces of any size, lines continued by a backslash, and the tags
// clang-format off
//
//     t NAME INTS/FLOATS/STRINGS  integers... floats... strings...        all ids count from 0, unlike those of `f`
//
//     crease 2/1/0 a b s          the edge between vertices a and b; more pairs may follow, with one sharpness or one each
//     corner 1/1/0 v s            likewise
//     hole 1/0/0 f                any number of faces
//     interpolateboundary 1/0/0 n              0 none, 1 edge-and-corner, 2 edge-only
//     creasemethod 0/0/1 normal|chaikin        and smoothtriangles 0/0/1 catmark|smooth
//     facevaryinginterpolateboundary 1/0/0 n   0 none, 1 corners-only, 2 corners-plus1, 3 corners-plus2, 4 boundaries, 5 all
//     facevaryingpropagatecorners 1/0/0 n      0 or 1: checked, not kept
// clang-format on
//
// Texture coordinates, `vt u [v [w]]`, become the face-varying channel "uv" where every corner of every face has one;
// where only some have, none is kept, and a warning says so. Indices into a file without `vt` are skipped. Groups, `g`,
// and objects, `o`, name faces: the words of a `g` are one name, and without a word it ends the group. Normals,
// materials, points and lines are skipped; unknown keywords, unknown tags and hierarchical edits are skipped
// with a warning. So are free-form curves and surfaces, which free_form.h reads: the warning says how many there are.
#include <filesystem>
#include <string>
#include <string_view>

#include "sublimit/io/write_mesh.h"
#include "sublimit/mesh/control_mesh.h"

namespace sublimit {

/// The mesh in a file.
/// @throws FormatError    what cannot be understood, with file:line and what would be right
/// @throws InvalidMesh    what can, but is no mesh: indices out of range, tags of edges that no face has, no faces,
///                        free-form curves and surfaces only
/// @throws IoError        missing, unreadable;  ResourceError  more than memory or 32-bit indices hold
ControlMesh read_obj(const std::filesystem::path& path);

/// As `read_obj`, from text; messages start with `name`. Memory is in proportion to the text, whatever it says.
ControlMesh parse_obj(std::string_view text, std::string_view name);

/// How much of a file there is, or stands before a part of it.
struct ObjCounts {
  std::int64_t lines = 0, vertices = 0, texture_coordinates = 0, faces = 0;
};
/// Counts the elements in a part of a file, which consists of whole lines.
ObjCounts count_obj(std::string_view part);

/// A part of a file, to be joined with others: its own vertices and values, faces and tags with numbers of the whole.
/// What takes the whole is not checked: numbers out of range, edges of tags, that there are any vertices or faces.
/// @param before  of the file
/// @throws as `parse_obj`
ControlMesh parse_obj_part(std::string_view part, std::string_view name, const ObjCounts& before);

/// The text of a mesh and its tags. Numbers have the shortest form that reads back to the same bits; infinite sharpness
/// is written as 10.
/// @throws InvalidParameter  arrays that do not fit together;  InvalidMesh  positions or sharpness that are not finite
std::string format_obj(const MeshOutput& mesh);

/// `format_obj` into a file, which appears whole or not at all.
void write_obj(const std::filesystem::path& path, const MeshOutput& mesh,
               const std::function<void(std::int64_t)>& progress = {});

}  // namespace sublimit
