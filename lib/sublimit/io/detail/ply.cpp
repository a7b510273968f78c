// SPDX-License-Identifier: Apache-2.0
#include "sublimit/io/detail/ply.h"

#include <algorithm>

#include "sublimit/base/detail/read_file.h"
#include "sublimit/io/detail/ply_rows.h"
#include "sublimit/io/detail/ply_values.h"
#include "sublimit/io/detail/text_scanner.h"

namespace sublimit {
namespace {

/// Reads the elements of a file in the order of its header. `Values` is PlyTextValues or PlyBinaryValues.
/// @param further  names of properties of vertices
template <class Values>
Mesh read(std::string_view bytes, const PlyHeader& header, const std::string& name,
          std::span<const std::string> further) {
  const PlyElement& vertex = require_element(header, name, "vertex", "x, y and z");
  const Index num_vertices = checked_index(vertex.count, name, "vertices");
  const PlyElement& face = require_element(header, name, "face", "vertex_indices");
  checked_index(face.count, name, "faces");
  const PlyVertices vertices(vertex, name, further);
  const PlyFaces faces(face, name, num_vertices);

  Mesh mesh;
  for (const PlyProperty* const property : vertices.further())
    mesh.vertex_values.push_back(
        {property->name, std::vector<double>(std::size_t(num_vertices)), is_integer(property->type)});
  mesh.positions.resize(num_vertices, 3);  // the file is long enough for three columns of so many rows
  std::vector<double> row(3 + mesh.vertex_values.size());
  Values values(bytes, header, name);
  for (const PlyElement& element : header.elements) {
    if (&element == &vertex) {
      for (Index v = 0; v < num_vertices; ++v) {
        vertices.read(values, v, row);
        std::copy_n(row.begin(), 3, mesh.positions.row(v).data());
        for (std::size_t i = 0; i < mesh.vertex_values.size(); ++i)
          mesh.vertex_values[i].values[std::size_t(v)] = row[3 + i];
      }
    } else if (&element == &face) {
      for (std::int64_t f = 0; f < face.count; ++f) {
        mesh.face_sizes.push_back(faces.read(values, f, mesh.face_vertices));
        checked_index(std::ssize(mesh.face_vertices), name, "corners of faces");
      }
    } else {
      skip(values, element);
    }
  }
  if (!values.at_end()) mesh.warnings.push_back(values.place() + "data behind the last element ignored");
  return mesh;
}

}  // namespace

Mesh read_ply(const std::filesystem::path& path) { return parse_ply(read_file(path), path.string()); }

Mesh parse_ply(std::string_view bytes, std::string_view name) { return parse_ply(bytes, name, {}); }

Mesh read_ply(const std::filesystem::path& path, std::span<const std::string> names) {
  return parse_ply(read_file(path), path.string(), names);
}

Mesh parse_ply(std::string_view bytes, std::string_view name, std::span<const std::string> names) {
  const PlyHeader header = parse_ply_header(bytes, name);
  const std::string file(name);
  return header.encoding == PlyHeader::Encoding::text ? read<PlyTextValues>(bytes, header, file, names)
                                                      : read<PlyBinaryValues>(bytes, header, file, names);
}

}  // namespace sublimit
