// SPDX-License-Identifier: Apache-2.0
#include "sublimit/io/write_mesh.h"

#include <algorithm>
#include <cmath>

#include "sublimit/base/atomic_file.h"
#include "sublimit/base/error.h"
#include "sublimit/base/format_number.h"
#include "sublimit/io/file_extension.h"
#include "sublimit/io/obj.h"
#include "sublimit/io/ply.h"

namespace sublimit {
namespace {

void require(bool holds, const std::string& name, const char* what) {
  if (!holds) throw InvalidParameter(name + ": " + what);
}

void check_finite(const Points& points, const std::string& name, const char* what) {
  if (points.allFinite()) return;
  for (Index row = 0; row < points.rows(); ++row) {
    if (points.row(row).allFinite()) continue;
    throw InvalidMesh(name + ": " + what + " " + format_number(row) +
                      " has a coordinate that is infinite or not a number; nothing is written");
  }
}

bool in_range(const std::vector<Index>& ids, Index first, Eigen::Index count) {
  return std::all_of(ids.begin(), ids.end(), [&](Index id) { return id >= first && id < count; });
}

void check_sharpness(float sharpness, const std::string& name) {
  if (sharpness >= 0) return;
  throw InvalidMesh(name + ": a sharpness is " + format_number(sharpness) + "; it should be 0 or more");
}

}  // namespace

MeshOutput output(ControlMesh mesh) {
  MeshOutput out;
  out.positions.swap(mesh.positions);
  out.face_sizes = std::move(mesh.face_sizes);
  out.face_vertices = std::move(mesh.face_vertices);
  out.face_varying = std::move(mesh.face_varying);
  out.creases = std::move(mesh.creases);
  out.corners = std::move(mesh.corners);
  out.holes = std::move(mesh.holes);
  out.knot_intervals = std::move(mesh.knot_intervals);
  out.boundary = mesh.boundary;
  out.creasing = mesh.creasing;
  out.triangles = mesh.triangles;
  out.face_varying_interpolation = mesh.face_varying_interpolation;
  return out;
}

void check_output(const MeshOutput& mesh, const std::string& name) {
  const Eigen::Index vertices = mesh.positions.rows();
  require(mesh.positions.cols() == 3, name, "positions should have 3 columns");
  require(in_range(mesh.face_vertices, 0, vertices), name, "a vertex of a face is out of range");
  std::int64_t corners = 0;
  for (const Index size : mesh.face_sizes) {
    require(size >= 3, name, "a face has fewer than 3 corners");
    corners += size;
  }
  require(corners == std::int64_t(mesh.face_vertices.size()), name, "sizes of faces do not add up to their vertices");

  const Eigen::Index normals = mesh.normals.rows();
  require(normals == 0 || mesh.normals.cols() == 3, name, "normals should have 3 columns");
  if (mesh.face_normals.empty()) {
    require(normals == 0 || normals == vertices, name, "there should be a normal for each vertex, or for none");
  } else {
    require(mesh.face_normals.size() == mesh.face_vertices.size(), name, "there should be a normal for each corner");
    require(in_range(mesh.face_normals, -1, normals), name, "a normal of a corner is out of range");
  }

  for (const ControlMesh::FaceVarying& channel : mesh.face_varying) {
    require(channel.indices.size() == mesh.face_vertices.size(), name,
            "there should be a face-varying value for each corner");
    require(in_range(channel.indices, 0, channel.values.rows()), name,
            "a face-varying value of a corner is out of range");
    check_finite(channel.values, name, "face-varying value");
  }

  for (const ControlMesh::Crease& crease : mesh.creases) {
    require(in_range({crease.tail, crease.head}, 0, vertices), name, "a vertex of a crease is out of range");
    check_sharpness(crease.sharpness, name);
  }
  for (const ControlMesh::KnotInterval& interval : mesh.knot_intervals) {
    require(in_range({interval.tail, interval.head}, 0, vertices), name, "a vertex of a knot interval is out of range");
    if (!std::isfinite(interval.length) || interval.length < 0)
      throw InvalidMesh(name + ": a knot interval is " + format_number(interval.length) + "; it should be positive");
  }
  for (const ControlMesh::Corner& corner : mesh.corners) {
    require(in_range({corner.vertex}, 0, vertices), name, "the vertex of a corner is out of range");
    check_sharpness(corner.sharpness, name);
  }
  require(in_range(mesh.holes, 0, Eigen::Index(mesh.face_sizes.size())), name, "the face of a hole is out of range");
  check_finite(mesh.positions, name, "vertex");
  check_finite(mesh.normals, name, "normal");
}

void write_mesh(const std::filesystem::path& path, const MeshOutput& mesh) {
  const std::string extension = file_extension(path);
  if (extension == ".obj") return write_obj(path, mesh);
  if (extension == ".ply") return write_ply(path, mesh);
  throw InvalidOption(path.string() + ": meshes are written as .obj or .ply, not as '" + extension + "'");
}

void write_through_buffer(const std::filesystem::path& path,
                          const std::function<void(std::string& buffer, const Flush& flush)>& emit) {
  constexpr std::size_t chunk = std::size_t{1} << 20;
  AtomicFile file(path);
  std::string buffer;
  buffer.reserve(chunk + (std::size_t{1} << 16));
  emit(buffer, [&](std::string& full) {
    if (full.size() < chunk) return;
    file.write(full);
    full.clear();
  });
  file.write(buffer);
  file.commit();
}

}  // namespace sublimit
