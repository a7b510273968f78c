// SPDX-License-Identifier: Apache-2.0
// Rows of a binary .ply by many ranks, read by lib's reader of rows (ply_rows.h) from any byte on.
#include <fmt/core.h>

#include <algorithm>

#include "sublimit/base/error.h"
#include "sublimit/distributed/mesh/spread_readers.h"
#include "sublimit/io/detail/ply_rows.h"

namespace sublimit {
namespace {

/// The mesh in a binary .ply, and where its rows begin.
struct PlyFile {
  PlyFile(std::string_view all, const PlyHeader& header, const std::string& file)
      : bytes(all),
        name(file),
        values(all, header, file),
        vertex(require_element(header, file, "vertex", "x, y and z")),
        face(require_element(header, file, "face", "vertex_indices")),
        vertices(vertex, file, {}),
        faces(face, file, vertex.count) {
    first_face = header.size;
    for (const PlyElement& element : header.elements) {
      if (&element == &face) break;
      const std::optional<std::int64_t> size = row_size(element);
      if (!size)
        throw FormatError(name + ": rows of element '" + element.name +
                          "' have lists; nothing but faces may, where each rank reads its own bytes");
      if (&element == &vertex) first_vertex = first_face;
      if (*size > 0 && element.count > (std::ssize(bytes) - first_face) / *size)
        throw FormatError(name + ": the data ends before the header's counts are met");
      first_face += *size * element.count;
    }
    if (first_vertex == 0)
      throw FormatError(name +
                        ": faces are before the vertices; they should be behind them, where each rank reads its "
                        "own bytes");
  }

  std::string_view bytes;
  std::string name;
  PlyBinaryValues values;
  const PlyElement &vertex, &face;
  PlyVertices vertices;
  PlyFaces faces;
  std::int64_t first_vertex = 0, first_face = 0;  ///< bytes
};

Points own_vertices(const Ranks& ranks, PlyFile& file, const Runs& runs) {
  const std::int64_t first = runs.begin(ranks.rank()), count = runs.size(ranks.rank());
  Points positions(count, 3);
  file.values.move_to(file.first_vertex + first * *row_size(file.vertex));
  for (std::int64_t v = 0; v < count; ++v)
    file.vertices.read(file.values, first + v, std::span(positions.row(v).data(), 3));
  return positions;
}

/// Equal runs, if all rows are as long as the first: every rank looks whether its own are, and the first one's begin
/// where they should, so all of them do if all ranks say so.
bool read_equal_rows(const Ranks& ranks, PlyFile& file, SpreadMesh& mesh) {
  const Runs runs = Runs::equal(file.face.count, ranks.size());
  const std::int64_t own = runs.size(ranks.rank());
  bool is_equal = true;
  try {
    std::vector<std::int64_t> corners;
    file.values.move_to(file.first_face);
    const Index size = file.faces.read(file.values, 0, corners);
    const std::int64_t row = file.values.offset() - file.first_face;
    is_equal = row <= (std::ssize(file.bytes) - file.first_face) / file.face.count;
    if (is_equal) {
      mesh.face_vertices.reserve(static_cast<size_t>(size * own));
      file.values.move_to(file.first_face + runs.begin(ranks.rank()) * row);
    }
    for (std::int64_t f = 0; f < own && is_equal; ++f) {
      const std::int64_t begin = file.values.offset();
      is_equal = file.faces.read(file.values, f, mesh.face_vertices) == size && file.values.offset() - begin == row;
    }
    mesh.face_sizes.assign(static_cast<size_t>(own), size);
  } catch (const Error&) {
    is_equal = false;  // or it is wrong somewhere: reading row by row tells where
  }
  if (ranks.all(is_equal)) return true;
  mesh.face_sizes.clear(), mesh.face_vertices.clear();
  return false;
}

/// Those that begin in a rank's own bytes. Rows are of any length, so each rank hands on where the next one begins.
void read_own_faces(const Ranks& ranks, PlyFile& file, SpreadMesh& mesh) {
  if (read_equal_rows(ranks, file, mesh)) {
    mesh.faces = Runs(ranks, std::ssize(mesh.face_sizes));
    return;
  }
  const Runs parts = Runs::equal(std::ssize(file.bytes) - file.first_face, ranks.size());
  const std::int64_t until = file.first_face + parts.begin(ranks.rank()) + parts.size(ranks.rank());
  // Pages come from the disk on all ranks at once, not in the order of the ranks.
  unsigned char touched = 0;
  for (std::int64_t at = until - parts.size(ranks.rank()); at < until; at += 4096)
    touched = static_cast<unsigned char>(touched ^ static_cast<unsigned char>(file.bytes[size_t(at)]));
  if (ranks.rank() < 0) fmt::print("{}", touched);  // which is never so: the loop must stay
  const auto [end, count] = ranks.handed_on({file.first_face, 0}, [&](std::array<std::int64_t, 2> begin) {
    file.values.move_to(begin[0]);
    std::int64_t face = begin[1];
    for (; face < file.face.count && file.values.offset() < until; ++face)
      mesh.face_sizes.push_back(file.faces.read(file.values, face, mesh.face_vertices));
    return std::array{file.values.offset(), face};
  });
  ranks.together([&, faces = count] {
    if (faces < file.face.count) throw FormatError(file.name + ": the data ends before the header's counts are met");
  });
  mesh.faces = Runs(ranks, std::ssize(mesh.face_sizes));
}

}  // namespace

SpreadMesh read_ply_parts(const Ranks& ranks, std::string_view bytes, const std::string& name) {
  SpreadMesh mesh;
  PlyHeader header;
  std::optional<PlyFile> file;
  ranks.together([&] {
    header = parse_ply_header(bytes, name);
    if (header.encoding == PlyHeader::Encoding::text)
      throw FormatError(name +
                        ": a .ply of text has no rows of known length; write a binary one, an .obj or a .safetensors");
    file.emplace(bytes, header, name);
    check_room(ranks, double(file->face.count), name);
    mesh.vertices = Runs::equal(file->vertex.count, ranks.size());
    mesh.positions = own_vertices(ranks, *file, mesh.vertices);
  });
  read_own_faces(ranks, *file, mesh);
  return mesh;
}

}  // namespace sublimit
