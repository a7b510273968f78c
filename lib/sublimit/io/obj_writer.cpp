// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "sublimit/base/error.h"
#include "sublimit/base/format_number.h"
#include "sublimit/io/obj.h"

namespace sublimit {
namespace {

void emit_rows(const char* keyword, const Points& rows, std::string& out, const Flush& flush) {
  for (Eigen::Index row = 0; row < rows.rows(); ++row) {
    out += keyword;
    for (Eigen::Index i = 0; i < rows.cols(); ++i) {
      out += ' ';
      append_number(out, rows(row, i));
    }
    out += '\n';
    flush(out);
  }
}

void emit_faces(const MeshOutput& mesh, std::string& out, const Flush& flush) {
  std::size_t first = 0;
  for (const Index size : mesh.face_sizes) {
    const std::size_t last = first + static_cast<std::size_t>(size);
    const bool per_corner = !mesh.face_normals.empty();
    bool normals = mesh.normals.rows() > 0;
    const std::vector<Index>* const values = mesh.face_varying.empty() ? nullptr : &mesh.face_varying[0].indices;
    for (std::size_t i = first; per_corner && i < last; ++i) normals = normals && mesh.face_normals[i] >= 0;
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
    flush(out);
  }
}

void append_sharpness(std::string& out, float sharpness) {
  out += ' ';
  append_number(out, std::isinf(sharpness) ? 10.0f : sharpness);
  out += '\n';
}

void emit_tags(const MeshOutput& mesh, std::string& out, const Flush& flush) {
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
  for (const ControlMesh::Crease& crease : mesh.creases) {
    out += "t crease 2/1/0 ";
    append_number(out, crease.tail);
    out += ' ';
    append_number(out, crease.head);
    append_sharpness(out, crease.sharpness);
    flush(out);
  }
  for (const ControlMesh::Corner& corner : mesh.corners) {
    out += "t corner 1/1/0 ";
    append_number(out, corner.vertex);
    append_sharpness(out, corner.sharpness);
    flush(out);
  }
  for (const ControlMesh::KnotInterval& interval : mesh.knot_intervals) {
    out += "t knotinterval 2/1/0 ";
    append_number(out, interval.tail);
    out += ' ';
    append_number(out, interval.head);
    out += ' ';
    append_number(out, interval.length);
    out += '\n';
    flush(out);
  }
  for (const Index hole : mesh.holes) {
    out += "t hole 1/0/0 ";
    append_number(out, hole);
    out += '\n';
    flush(out);
  }
}

void emit_obj(const MeshOutput& mesh, std::string& out, const Flush& flush) {
  for (const std::string& comment : mesh.comments) {
    out += "# ";
    for (const char c : comment) {
      if (c != '\r') out += c == '\n' ? std::string_view("\n# ") : std::string_view(&c, 1);
    }
    out += '\n';
  }
  emit_rows("v", mesh.positions, out, flush);
  if (!mesh.face_varying.empty()) emit_rows("vt", mesh.face_varying[0].values, out, flush);
  emit_rows("vn", mesh.normals, out, flush);
  emit_faces(mesh, out, flush);
  emit_tags(mesh, out, flush);
}

void check_obj(const MeshOutput& mesh, const std::string& name) {
  check_output(mesh, name);
  if (mesh.face_varying.empty()) return;
  const Eigen::Index columns = mesh.face_varying[0].values.cols();
  if (mesh.face_varying.size() > 1 || columns < 1 || columns > 3)
    throw InvalidParameter(name +
                           ": an OBJ has room for one face-varying channel of 1 to 3 columns, its texture coordinates");
}

}  // namespace

std::string format_obj(const MeshOutput& mesh) {
  check_obj(mesh, "OBJ");
  std::string text;
  emit_obj(mesh, text, [](std::string&) {});
  return text;
}

void write_obj(const std::filesystem::path& path, const MeshOutput& mesh) {
  check_obj(mesh, path.string());
  write_through_buffer(path, [&](std::string& buffer, const Flush& flush) { emit_obj(mesh, buffer, flush); });
}

}  // namespace sublimit
