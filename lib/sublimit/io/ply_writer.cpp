// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <utility>

#include "sublimit/base/detail/row_writer.h"
#include "sublimit/base/error.h"
#include "sublimit/io/detail/ply.h"
#include "sublimit/io/detail/ply_header.h"
#include "sublimit/io/detail/writer_parts.h"

namespace sublimit {
namespace {

constexpr std::int64_t ply_rows_per_block = 4096;
constexpr bool is_little_endian = std::endian::native == std::endian::little;

/// Puts down the bytes of a number, least first, and moves behind them.
template <class T>
void put(char*& at, T value) {
  char bytes[sizeof value];
  std::memcpy(bytes, &value, sizeof value);
  if (!is_little_endian) std::reverse(bytes, bytes + sizeof value);
  std::memcpy(at, bytes, sizeof value);
  at += sizeof value;
}

/// Makes room for bytes at the end of `out`.
char* extend(std::string& out, std::size_t bytes) {
  const std::size_t size = out.size();
  out.resize(size + bytes);
  return out.data() + size;
}

std::string format_header(const Mesh& mesh, bool wide) {
  PlyElement vertex{.name = "vertex", .count = mesh.positions.rows(), .properties = {}};
  PlyElement face{.name = "face", .count = std::ssize(mesh.face_sizes), .properties = {}};
  const auto add_double = [&](const char* name) { vertex.properties.push_back({name, PlyType::float64, {}}); };
  for (const char* const name : {"x", "y", "z"}) add_double(name);
  if (mesh.normals.rows() > 0)
    for (const char* const name : {"nx", "ny", "nz"}) add_double(name);
  if (mesh.texture.rows() > 0)
    for (const char* const name : {"s", "t"}) add_double(name);
  for (const Mesh::VertexValues& further : mesh.vertex_values)
    vertex.properties.push_back({further.name, further.whole ? PlyType::int32 : PlyType::float64, {}});
  face.properties.push_back({"vertex_indices", PlyType::int32, wide ? PlyType::uint32 : PlyType::uint8});
  if (!mesh.face_ids.empty()) face.properties.push_back({"face_id", PlyType::int32, {}});
  return format_ply_header({PlyHeader::Encoding::little_endian, {std::move(vertex), std::move(face)}},
                           format_comments(mesh.comments, "comment "));
}

void emit_vertices(const Mesh& mesh, RowWriter& out) {
  const bool normals = mesh.normals.rows() > 0, texture = mesh.texture.rows() > 0;
  std::size_t bytes_of_vertex = sizeof(double) * (3 + (normals ? 3 : 0) + (texture ? 2 : 0));
  for (const Mesh::VertexValues& further : mesh.vertex_values)
    bytes_of_vertex += further.whole ? sizeof(Index) : sizeof(double);
  const double* const positions = mesh.positions.data();
  if (is_little_endian && bytes_of_vertex == 3 * sizeof(double))  // they lie in memory as they should in the file
    return out.write({reinterpret_cast<const char*>(positions), std::size_t(mesh.positions.size()) * sizeof(double)});
  out.rows(mesh.positions.rows(), ply_rows_per_block, [&](std::string& bytes, std::int64_t begin, std::int64_t end) {
    char* at = extend(bytes, std::size_t(end - begin) * bytes_of_vertex);
    for (std::int64_t v = begin; v < end; ++v) {
      for (int i = 0; i < 3; ++i) put(at, positions[3 * v + i]);
      for (int i = 0; normals && i < 3; ++i) put(at, mesh.normals.data()[3 * v + i]);
      for (int i = 0; texture && i < 2; ++i) put(at, mesh.texture.data()[2 * v + i]);
      for (const Mesh::VertexValues& further : mesh.vertex_values) {
        const double value = further.values[std::size_t(v)];
        if (further.whole)
          put(at, static_cast<Index>(value));
        else
          put(at, value);
      }
    }
  });
}

template <class Size>
void emit_faces(const Mesh& mesh, RowWriter& out) {
  const std::vector<std::size_t> first = first_corners(mesh.face_sizes, ply_rows_per_block);
  const std::size_t num_corners = mesh.face_vertices.size();
  const auto num_faces = std::ssize(mesh.face_sizes);
  out.rows(num_faces, ply_rows_per_block, [&](std::string& bytes, std::int64_t begin, std::int64_t end) {
    const std::size_t corner = first[std::size_t(begin / ply_rows_per_block)];
    const std::size_t last = end == num_faces ? num_corners : first[std::size_t(end / ply_rows_per_block)];
    const std::size_t a_face = sizeof(Size) + (mesh.face_ids.empty() ? 0 : sizeof(Index));
    char* at = extend(bytes, std::size_t(end - begin) * a_face + (last - corner) * sizeof(Index));
    const Index* vertex = mesh.face_vertices.data() + corner;
    for (std::int64_t face = begin; face < end; ++face) {
      const Index size = mesh.face_sizes[std::size_t(face)];
      put(at, static_cast<Size>(size));
      for (Index i = 0; i < size; ++i) put(at, *vertex++);
      if (!mesh.face_ids.empty()) put(at, mesh.face_ids[std::size_t(face)]);
    }
  });
}

void emit_ply(const Mesh& mesh, RowWriter out) {
  // Nearly all readers expect one byte for the size of a face: only faces that need more get more.
  const bool wide = std::ranges::any_of(mesh.face_sizes, [](Index size) { return size > 255; });
  out.write(format_header(mesh, wide));
  emit_vertices(mesh, out);
  if (wide) {
    emit_faces<std::uint32_t>(mesh, out);
  } else {
    emit_faces<std::uint8_t>(mesh, out);
  }
}

void check(const Mesh& mesh, const std::string& name) {
  check_output(mesh, name);
  if (mesh.face_normals.empty()) return;
  throw InvalidParameter(name + ": a PLY file has one normal per vertex, these are per corner; write an .obj");
}

}  // namespace

std::string format_ply(const Mesh& mesh) {
  check(mesh, "PLY");
  std::string bytes;
  emit_ply(mesh, RowWriter(bytes));
  return bytes;
}

void write_ply(const std::filesystem::path& path, const Mesh& mesh, const std::function<void(std::int64_t)>& progress) {
  check(mesh, path.string());
  AtomicFile file(path, progress);
  emit_ply(mesh, RowWriter(file));
  file.commit();
}

}  // namespace sublimit
