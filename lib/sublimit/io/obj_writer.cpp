// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/detail/row_writer.h"
#include "sublimit/base/error.h"
#include "sublimit/io/detail/obj.h"
#include "sublimit/io/detail/writer_parts.h"
#include "sublimit/mesh/detail/attributes.h"

namespace sublimit {
namespace {

constexpr std::int64_t obj_rows_per_block = 2048;

void emit_rows(const char* keyword, const Points& rows, RowWriter& out) {
  out.rows(rows.rows(), obj_rows_per_block, [&](std::string& text, std::int64_t begin, std::int64_t end) {
    for (Eigen::Index row = begin; row < end; ++row) {
      text += keyword;
      for (Eigen::Index i = 0; i < rows.cols(); ++i) {
        text += ' ';
        append_number(text, rows(row, i));
      }
      text += '\n';
    }
  });
}

/// Vertices, with their colours.
void emit_vertices(const Mesh& mesh, RowWriter& out) {
  const auto colours = find_colours(mesh.vertex_values);
  if (!colours) return emit_rows("v", mesh.positions, out);
  Points rows(mesh.num_vertices(), 3 + ((*colours)[3] >= 0 ? 4 : 3));
  rows.leftCols(3) = mesh.positions;
  for (Eigen::Index k = 3; k < rows.cols(); ++k)
    for (Eigen::Index v = 0; v < rows.rows(); ++v)
      rows(v, k) = colour_in_unit(mesh.vertex_values[std::size_t((*colours)[std::size_t(k - 3)])], std::size_t(v));
  emit_rows("v", rows, out);
}

/// A line that names the faces from here on, where the name changes.
void append_name(const char* keyword, const Mesh::FaceNames& names, std::int64_t face, std::string& out) {
  if (names.of_face.empty()) return;
  const Index* const name = names.of_face.data() + face;
  if (face == 0 ? *name < 0 : *name == name[-1]) return;
  out += keyword;
  if (*name >= 0) out += ' ' + names.names[std::size_t(*name)];
  out += '\n';
}

/// @param first  corner of face `begin`
void append_faces(const Mesh& mesh, std::int64_t begin, std::int64_t end, std::size_t first, std::string& out) {
  const bool per_corner = !mesh.face_normals.empty();
  const std::vector<Index>* const values = mesh.face_varying.empty() ? nullptr : &mesh.face_varying[0].indices;
  for (std::int64_t face = begin; face < end; ++face) {
    const std::size_t last = first + static_cast<std::size_t>(mesh.face_sizes[static_cast<std::size_t>(face)]);
    bool normals = mesh.normals.rows() > 0;
    for (std::size_t i = first; per_corner && i < last; ++i) normals = normals && mesh.face_normals[i] >= 0;
    if (!mesh.face_ids.empty()) {
      const Index* const id = mesh.face_ids.data() + face;
      if (face == 0 || *id != id[-1]) {
        out += "g face_";
        append_number(out, *id);
        out += '\n';
      }
    }
    append_name("o", mesh.objects, face, out);
    if (mesh.face_ids.empty()) append_name("g", mesh.groups, face, out);
    append_name("usemtl", mesh.materials, face, out);
    append_name("s", mesh.smoothing_groups, face, out);
    out += 'f';
    for (std::size_t i = first; i < last; ++i) {
      out += ' ';
      append_number(out, mesh.face_vertices[i] + 1);
      if (values || normals) out += '/';
      if (values) append_number(out, (*values)[i] + 1);
      if (!normals) continue;
      out += '/';
      append_number(out, (per_corner ? mesh.face_normals : mesh.face_vertices)[i] + 1);
    }
    out += '\n';
    first = last;
  }
}

void emit_faces(const Mesh& mesh, RowWriter& out) {
  const std::vector<std::size_t> first = first_corners(mesh.face_sizes, obj_rows_per_block);
  out.rows(std::ssize(mesh.face_sizes), obj_rows_per_block,
           [&](std::string& text, std::int64_t begin, std::int64_t end) {
             append_faces(mesh, begin, end, first[static_cast<std::size_t>(begin / obj_rows_per_block)], text);
           });
}

void append_sharpness(std::string& out, float sharpness) {
  out += ' ';
  append_number(out, std::isinf(sharpness) ? 10.0f : sharpness);
  out += '\n';
}

std::string format_rules(const Mesh& mesh) {
  std::string out;
  if (mesh.boundary) {
    out += "t interpolateboundary 1/0/0 ";
    switch (*mesh.boundary) {
      case Boundary::none:
        out += "0\n";
        break;
      case Boundary::edge_and_corner:
        out += "1\n";
        break;
      case Boundary::edge_only:
        out += "2\n";
        break;
    }
  }
  if (mesh.creasing) {
    out += *mesh.creasing == Creasing::chaikin ? "t creasemethod 0/0/1 chaikin\n" : "t creasemethod 0/0/1 normal\n";
  }
  if (mesh.triangles) {
    out +=
        *mesh.triangles == Triangles::smooth ? "t smoothtriangles 0/0/1 smooth\n" : "t smoothtriangles 0/0/1 catmark\n";
  }
  if (mesh.face_varying_interpolation) {
    out += "t facevaryinginterpolateboundary 1/0/0 ";
    append_number(out, static_cast<int>(*mesh.face_varying_interpolation));
    out += '\n';
  }
  return out;
}

/// One line for each of a list: `append(out, element)`.
template <class T>
void emit_lines(const std::vector<T>& list, RowWriter& out, const auto& append) {
  out.rows(std::ssize(list), obj_rows_per_block, [&](std::string& text, std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i < end; ++i) append(text, list[static_cast<std::size_t>(i)]);
  });
}

void emit_tags(const Mesh& mesh, RowWriter& out) {
  out.write(format_rules(mesh));
  emit_lines(mesh.creases, out, [](std::string& text, const Mesh::Crease& crease) {
    text += "t crease 2/1/0 ";
    append_number(text, crease.tail);
    text += ' ';
    append_number(text, crease.head);
    append_sharpness(text, crease.sharpness);
  });
  emit_lines(mesh.corners, out, [](std::string& text, const Mesh::Corner& corner) {
    text += "t corner 1/1/0 ";
    append_number(text, corner.vertex);
    append_sharpness(text, corner.sharpness);
  });
  emit_lines(mesh.knot_intervals, out, [](std::string& text, const Mesh::KnotInterval& interval) {
    text += "t knotinterval 2/1/0 ";
    append_number(text, interval.tail);
    text += ' ';
    append_number(text, interval.head);
    text += ' ';
    append_number(text, interval.length);
    text += '\n';
  });
  emit_lines(mesh.holes, out, [](std::string& text, Index hole) {
    text += "t hole 1/0/0 ";
    append_number(text, hole);
    text += '\n';
  });
}

void emit_obj(const Mesh& mesh, RowWriter out) {
  out.write(format_comments(mesh.comments, "# "));
  for (const std::string& file : mesh.material_files) out.write("mtllib " + file + '\n');
  emit_vertices(mesh, out);
  if (!mesh.face_varying.empty()) emit_rows("vt", mesh.face_varying[0].values, out);
  emit_rows("vn", mesh.normals, out);
  emit_faces(mesh, out);
  emit_tags(mesh, out);
}

void check_obj(const Mesh& mesh, const std::string& name) {
  check_output(mesh, name);
  if (const auto colours = find_colours(mesh.vertex_values))
    for (const Index k : *colours)
      if (k >= 0 &&
          !std::ranges::all_of(mesh.vertex_values[std::size_t(k)].values, [](double x) { return std::isfinite(x); }))
        throw InvalidMesh(name +
                          ": a colour of a vertex is infinite or not a number; write a .ply, or drop the values");
  if (mesh.face_varying.empty()) return;
  const Eigen::Index columns = mesh.face_varying[0].values.cols();
  if (mesh.face_varying.size() > 1 || columns < 1 || columns > 3)
    throw InvalidParameter(name +
                           ": an OBJ has room for one face-varying channel of 1 to 3 columns, its texture coordinates");
}

}  // namespace

std::string format_obj(const Mesh& mesh) {
  check_obj(mesh, "OBJ");
  std::string text;
  emit_obj(mesh, RowWriter(text));
  return text;
}

void write_obj(const std::filesystem::path& path, const Mesh& mesh, const std::function<void(std::int64_t)>& progress) {
  check_obj(mesh, path.string());
  AtomicFile file(path, progress);
  emit_obj(mesh, RowWriter(file));
  file.commit();
}

}  // namespace sublimit
