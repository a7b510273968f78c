// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <bit>
#include <concepts>
#include <cstdint>

#include "sublimit/base/error.h"
#include "sublimit/base/format_number.h"
#include "sublimit/io/ply.h"

namespace sublimit {
namespace {

// Appends the bytes of an integer, least first.
void append_bytes(std::string& out, std::unsigned_integral auto value) {
  char bytes[sizeof value];
  for (std::size_t i = 0; i < sizeof value; ++i) bytes[i] = static_cast<char>(value >> 8 * i & 0xff);
  out.append(bytes, sizeof value);
}

void append_row(std::string& out, const Points& points, Eigen::Index row) {
  for (Eigen::Index i = 0; i < 3; ++i) append_bytes(out, std::bit_cast<std::uint64_t>(points(row, i)));
}

void emit_header(const MeshOutput& mesh, bool wide, std::string& out) {
  out += "ply\nformat binary_little_endian 1.0\n";
  for (const std::string& comment : mesh.comments) {
    out += "comment ";
    for (const char c : comment) {
      if (c != '\r') out += c == '\n' ? std::string_view("\ncomment ") : std::string_view(&c, 1);
    }
    out += '\n';
  }
  out += "element vertex " + format_number(mesh.positions.rows()) + "\n";
  for (const char* const name : {"x", "y", "z"}) out += std::string("property double ") + name + "\n";
  if (mesh.normals.rows() > 0) {
    for (const char* const name : {"nx", "ny", "nz"}) out += std::string("property double ") + name + "\n";
  }
  out += "element face " + format_number(mesh.face_sizes.size()) + "\n";
  out += wide ? "property list uint int vertex_indices\n" : "property list uchar int vertex_indices\n";
  out += "end_header\n";
}

void emit_ply(const MeshOutput& mesh, std::string& out, const Flush& flush) {
  // Nearly all readers expect one byte for the size of a face: only faces that need more get more.
  const bool wide = std::ranges::any_of(mesh.face_sizes, [](Index size) { return size > 255; });
  emit_header(mesh, wide, out);
  for (Eigen::Index v = 0; v < mesh.positions.rows(); ++v) {
    append_row(out, mesh.positions, v);
    if (mesh.normals.rows() > 0) append_row(out, mesh.normals, v);
    flush(out);
  }
  const Index* vertex = mesh.face_vertices.data();
  for (const Index size : mesh.face_sizes) {
    if (wide) {
      append_bytes(out, static_cast<std::uint32_t>(size));
    } else {
      append_bytes(out, static_cast<std::uint8_t>(size));
    }
    for (Index i = 0; i < size; ++i) append_bytes(out, static_cast<std::uint32_t>(*vertex++));
    flush(out);
  }
}

void check(const MeshOutput& mesh, const std::string& name) {
  check_output(mesh, name);
  if (mesh.face_normals.empty()) return;
  throw InvalidParameter(name + ": a PLY file has one normal per vertex, these are per corner; write an .obj");
}

}  // namespace

std::string format_ply(const MeshOutput& mesh) {
  check(mesh, "PLY");
  std::string bytes;
  emit_ply(mesh, bytes, [](std::string&) {});
  return bytes;
}

void write_ply(const std::filesystem::path& path, const MeshOutput& mesh) {
  check(mesh, path.string());
  write_through_buffer(path, [&](std::string& buffer, const Flush& flush) { emit_ply(mesh, buffer, flush); });
}

}  // namespace sublimit
