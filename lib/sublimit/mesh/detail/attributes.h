// SPDX-License-Identifier: Apache-2.0
#pragma once
// What meshes carry besides their shape: values of vertices, names and values of faces. The same for each way from a
// mesh to another one: faces have what their parents had, values of vertices are columns beside the coordinates.
//
//   Mesh fine = ...;
//   carry_faces(control, parents, fine);
//   set_vertex_values(fine, control, S * vertex_values(control));
#include <array>
#include <optional>
#include <span>

#include "sublimit/mesh/mesh.h"

namespace sublimit {

/// Checks that all faces have a name or none, each of its list, and that values are one for each vertex or face.
/// @throws InvalidMesh  says what is missing
void check_attributes(const Mesh& mesh);

/// Names of values that are a colour.
inline constexpr std::array<const char*, 4> colour_names{"red", "green", "blue", "alpha"};
/// Returns the numbers of the values red, green, blue and alpha, -1 for no alpha; nothing if there is no colour.
std::optional<std::array<Index, 4>> find_colours(const std::vector<Mesh::Values>& values);
/// Returns a colour's number as 0 to 1.
inline double colour_in_unit(const Mesh::Values& channel, std::size_t i) {
  const double most = channel.type == ValueType::uint8 ? 255 : channel.type == ValueType::uint16 ? 65535 : 1;
  return channel.values[i] / most;
}

/// True if faces have names or values that are to be carried on.
bool has_face_attributes(const Mesh& mesh);
/// Gives faces the names and values of their parents, and a mesh its parent's files of materials.
/// @param parents  the parent of each face of `to`
/// @throws InvalidMesh  names or values of some of the parents alone
void carry_faces(const Mesh& from, std::span<const Index> parents, Mesh& to);
/// Gives a mesh of the same faces the names and values of these.
void carry_faces(const Mesh& from, Mesh& to);

/// Returns the values at vertices, #V x #values; no columns if they are to be left out.
/// @throws InvalidMesh  values of some of the vertices alone
Points vertex_values(const Mesh& mesh);
/// Gives a mesh values under the names and types that another one has.
/// @param columns  a row for each vertex of `to`, as from `vertex_values`
void set_vertex_values(Mesh& to, const Mesh& named, const Points& columns);

}  // namespace sublimit
