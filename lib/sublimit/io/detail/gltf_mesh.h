// SPDX-License-Identifier: Apache-2.0
#pragma once
// One mesh of a glTF file, as it is in the file: all its primitives, with vertices welded and values at them.
#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "sublimit/io/detail/equal_rows.h"
#include "sublimit/io/detail/gltf_file.h"
#include "sublimit/mesh/mesh.h"

namespace sublimit {

/// What a file has and a mesh has not, each kind with its first place and how often it was met.
class GltfReservations {
 public:
  /// @param what  about the thing at the place: "its skin is left out"
  void add(const std::string& what, const std::string& place);
  /// Returns messages, in the order in which kinds were met.
  std::vector<std::string> messages(const std::string& file) const;

 private:
  struct Kind {
    std::string what, first;
    std::int64_t count;
  };
  std::vector<Kind> kinds_;
};

/// Name that our writer gives to numbers of vertices: those of equal number and coordinates are one vertex, also of
/// several nodes, and others are none. Two whole numbers of 16 bits, the low one first.
inline constexpr std::string_view gltf_vertex_attribute = "_VERTEX";

/// A value at vertices. Colours are 0 to 1, whatever their type is.
struct GltfValues {
  std::string name;
  bool is_colour = false;
  ValueType type = ValueType::float32;
  std::vector<double> values = {};  ///< NaN: none
};

/// A mesh in its own coordinates.
struct GltfMesh {
  /// Coordinates of a vertex, and the number that our writer gave it, or -1.
  std::vector<EqualRowsOf<4>::Row> vertices = {};
  std::vector<Index> face_sizes = {}, face_vertices = {};
  std::vector<Index> materials = {};  ///< number in the file for each face, -1 for none
  EqualRows texture = {};             ///< vertex and texture coordinates
  std::vector<Index> corners = {};    ///< row in `texture` for each corner; empty: none
  std::vector<GltfValues> values = {};
  std::int64_t file_vertices = 0;  ///< before they were welded
};

/// Memory that meshes of a file share, which may have the same long accessor: for each of its rows the vertex, and the
/// primitive that set values there last; -1 between meshes.
struct GltfRows {
  std::vector<Index> vertex = {}, last_user = {};
};

/// Reads a mesh of a file.
/// @param reservations  where things that are left out are told
/// @throws FormatError, InvalidMesh, IoError, ResourceError  as `read_gltf`
GltfMesh read_gltf_mesh(GltfFile& file, std::int64_t number, GltfReservations& reservations, GltfRows& rows);

}  // namespace sublimit
