// SPDX-License-Identifier: Apache-2.0
#include <Eigen/Geometry>
#include <bit>
#include <cstdint>
#include <limits>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/detail/row_writer.h"
#include "sublimit/base/error.h"
#include "sublimit/io/detail/equal_rows.h"
#include "sublimit/io/detail/face_triangles.h"
#include "sublimit/io/detail/stl.h"
#include "sublimit/io/detail/writer_parts.h"
#include "sublimit/io/write_mesh.h"

namespace sublimit {
namespace {

constexpr std::int64_t faces_per_block = 2048;

void append_bytes(std::string& out, std::uint32_t value) {
  for (int i = 0; i < 4; ++i) out += static_cast<char>(value >> (8 * i) & 0xff);
}

/// Triangles of all faces.
std::int64_t num_triangles(const Mesh& mesh) {
  return std::ssize(mesh.face_vertices) - 2 * std::ssize(mesh.face_sizes);
}

void append_triangle(std::string& out, const Eigen::RowVector3d& a, const Eigen::RowVector3d& b,
                     const Eigen::RowVector3d& c) {
  Eigen::RowVector3d normal = (b - a).stableNormalized().cross((c - a).stableNormalized()).stableNormalized();
  if (!normal.allFinite()) normal.setZero();
  for (const Eigen::RowVector3d& row : {normal, a, b, c})
    for (const double x : row) append_bytes(out, std::bit_cast<std::uint32_t>(static_cast<float>(x)));
  out.append(2, '\0');
}

void emit_stl(const Mesh& mesh, RowWriter out) {
  std::string head = "triangles of a mesh";  // not "solid", with which text begins
  head.resize(80, '\0');
  append_bytes(head, static_cast<std::uint32_t>(num_triangles(mesh)));
  out.write(head);
  const std::vector<std::size_t> first = first_corners(mesh.face_sizes, faces_per_block);
  out.rows(std::ssize(mesh.face_sizes), faces_per_block, [&](std::string& bytes, std::int64_t begin, std::int64_t end) {
    const Index* vertex = mesh.face_vertices.data() + first[static_cast<std::size_t>(begin / faces_per_block)];
    FaceTriangles triangles;
    for (std::int64_t f = begin; f < end; ++f) {
      const Index size = mesh.face_sizes[static_cast<std::size_t>(f)];
      const auto corner = [&](Index i) { return mesh.positions.row(vertex[i]); };
      if (size == 3)
        append_triangle(bytes, corner(0), corner(1), corner(2));
      else
        for (const auto& [a, b, c] : triangles.cut(mesh.positions, {vertex, static_cast<std::size_t>(size)}))
          append_triangle(bytes, corner(a), corner(b), corner(c));
      vertex += size;
    }
  });
}

void check_stl(const Mesh& mesh, const std::string& name) {
  check_output(mesh, name);
  if (num_triangles(mesh) > std::numeric_limits<std::uint32_t>::max())
    throw ResourceError(name + ": " + format_number(num_triangles(mesh)) +
                        " triangles are more than an STL file can count; write a .ply");
  for (Eigen::Index v = 0; v < mesh.positions.rows(); ++v)
    if ((mesh.positions.row(v).array().abs() > std::numeric_limits<float>::max()).any())
      throw InvalidMesh(name + ": vertex " + format_number(v) +
                        " has a coordinate beyond the numbers of 32 bits that an STL file has; write a .ply");
}

}  // namespace

std::vector<std::string> changes_in_stl(const Mesh& mesh) {
  EqualRows exact, rounded;
  for (Eigen::Index v = 0; v < mesh.positions.rows(); ++v) {
    const double* const x = mesh.positions.row(v).data();
    exact.add({x[0], x[1], x[2]});
    rounded.add({double(float(x[0])), double(float(x[1])), double(float(x[2]))});
  }
  const std::size_t lost = exact.rows().size() - rounded.rows().size();
  if (lost == 0) return {};
  return {format_number(lost) + " of " + format_number(exact.rows().size()) +
          " different points become equal to another one in its numbers of 32 bits; move the mesh nearer to the "
          "origin, or write a .ply"};
}

std::string format_stl(const Mesh& mesh) {
  check_stl(mesh, "STL");
  std::string bytes;
  emit_stl(mesh, RowWriter(bytes));
  return bytes;
}

void write_stl(const std::filesystem::path& path, const Mesh& mesh, const std::function<void(std::int64_t)>& progress) {
  check_stl(mesh, path.string());
  AtomicFile file(path, progress);
  emit_stl(mesh, RowWriter(file));
  file.commit();
}

}  // namespace sublimit
