// SPDX-License-Identifier: Apache-2.0
#pragma once
// Wavefront OBJ with subdivision tags, read and written to the same bits.
//
// Taken: `v x y z` or `v x y z r g b [a]`, colours 0 to 1 (a weight is dropped), `f` with its vertices as `a`, `a/b`,
// `a//c` or `a/b/c`, negative ones counting backwards, faces of any size, lines continued by a backslash, and the tags
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
// where only some have, none is kept, and a warning says so. Indices into a file without `vt` are skipped, and 0 is
// none. Groups, `g`, objects, `o`, materials, `usemtl`, and smoothing groups, `s`, name faces: the words of a line are
// one name, and without a word the faces that follow have none. `mtllib` is kept. `call FILE` stands for the lines of
// that file. Normals, points and lines are skipped; unknown keywords, unknown tags and hierarchical edits are skipped
// with a warning. So are free-form curves and surfaces, which free_form.h reads: the warning says how many there are.
#include <filesystem>
#include <string>
#include <string_view>

#include "sublimit/io/write_mesh.h"
#include "sublimit/mesh/mesh.h"

namespace sublimit {

/// Reads the mesh of a file.
/// @throws FormatError    what cannot be understood, with file:line and what would be right
/// @throws InvalidMesh    what can, but is no mesh: indices out of range, tags of edges that no face has, no faces,
///                        free-form curves and surfaces only
/// @throws IoError        missing, unreadable;  ResourceError  more than memory or 32-bit indices hold
Mesh read_obj(const std::filesystem::path& path);

/// Reads a mesh from the text of an OBJ file. Memory is proportional to the length of the text.
/// @param name  name of the text, with which messages start
/// @throws as `read_obj`, but for IoError
Mesh parse_obj(std::string_view text, std::string_view name);

/// Numbers of elements in a file, or before a part of it.
struct ObjCounts {
  std::int64_t lines = 0, vertices = 0, texture_coordinates = 0, faces = 0;
};
/// Counts the elements in a part of a file, which consists of whole lines.
ObjCounts count_obj(std::string_view part);

/// A part of a file, to be joined with others: its own vertices and values, faces and tags with numbers of the whole.
/// Checks that need the whole file are left out: indices out of range, edges of tags, a file without vertices or faces.
/// @param before  numbers of elements of the file before this part
/// @throws as `parse_obj`
Mesh parse_obj_part(std::string_view part, std::string_view name, const ObjCounts& before);

/// Returns a mesh and its tags as the text of a file. Numbers have the shortest form that reads back to the same bits;
/// infinite sharpness is written as 10.
/// @throws InvalidParameter  arrays that do not fit together;  InvalidMesh  positions or sharpness that are not finite
std::string format_obj(const Mesh& mesh);

/// Writes a mesh to a file, which appears whole or not at all.
void write_obj(const std::filesystem::path& path, const Mesh& mesh,
               const std::function<void(std::int64_t)>& progress = {});

}  // namespace sublimit
