// SPDX-License-Identifier: Apache-2.0
#include "sublimit/io/write_mesh.h"

#include <algorithm>
#include <atomic>
#include <cmath>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/detail/parallel_for.h"
#include "sublimit/base/error.h"
#include "sublimit/io/detail/formats.h"
#include "sublimit/io/detail/gzip.h"
#include "sublimit/io/detail/obj_names.h"
#include "sublimit/mesh/detail/attributes.h"
#include "sublimit/mesh/detail/check_mesh.h"

namespace sublimit {
namespace {

void require(bool holds, const std::string& name, const char* what) {
  if (!holds) throw InvalidParameter(name + ": " + what);
}

/// Whether something holds for all of [0, count): `holds(begin, end)` for a part, by any thread.
bool holds_for_all(std::int64_t count, const auto& holds) {
  std::atomic<bool> all = true;
  parallel_for_blocks(
      count,
      [&](std::int64_t, std::int64_t begin, std::int64_t end) {
        if (!holds(static_cast<std::size_t>(begin), static_cast<std::size_t>(end))) all = false;
      },
      std::int64_t{1} << 16);
  return all;
}

void check_finite(const Points& points, const std::string& name, const char* what) {
  const double* const numbers = points.data();
  const bool all_finite = holds_for_all(points.size(), [&](std::size_t begin, std::size_t end) {
    bool finite = true;  // to the end of the part: a loop without a way out takes several numbers at once
    for (std::size_t i = begin; i < end; ++i) finite &= numbers[i] - numbers[i] == 0;
    return finite;
  });
  if (all_finite) return;
  for (Index row = 0; row < points.rows(); ++row) {
    if (points.row(row).allFinite()) continue;
    throw InvalidMesh(name + ": " + what + " " + format_number(row) +
                      " has a coordinate that is infinite or not a number; nothing is written");
  }
}

bool in_range(const std::vector<Index>& ids, Index first, Eigen::Index count) {
  return holds_for_all(std::ssize(ids), [&](std::size_t begin, std::size_t end) {
    bool all = true;
    for (std::size_t i = begin; i < end; ++i) {
      const Index id = ids[i];
      all &= id >= first && id < count;
    }
    return all;
  });
}

void check_name(const std::string& text, const std::string& name, const char* what) {
  if (has_comment(text) || text.find_first_of("\n\r") != std::string::npos || text.ends_with('\\'))
    throw InvalidParameter(
        name + ": a " + what +
        " has a character that OBJ has no way to write: the end of a line, # behind a blank or a last \\");
}

/// Whether no face has fewer than three corners, nor one at a vertex that there is not.
bool are_sound(const std::vector<Index>& face_sizes, const std::vector<Index>& face_vertices, Eigen::Index vertices) {
  std::int64_t corners = 0;
  for (const Index size : face_sizes) {
    if (size < 3) return false;
    corners += size;
  }
  return corners == std::ssize(face_vertices) && in_range(face_vertices, 0, vertices);
}

/// Runs checks that know nothing of files.
void naming(const std::string& name, const auto& check) {
  try {
    check();
  } catch (const InvalidMesh& error) {
    throw InvalidMesh(name + ": " + error.what());
  }
}

}  // namespace

void check_output(const Mesh& mesh, const std::string& name) {
  const Eigen::Index vertices = mesh.positions.rows();
  require(mesh.positions.cols() == 3, name, "positions should have 3 columns");
  if (!are_sound(mesh.face_sizes, mesh.face_vertices, vertices)) naming(name, [&] { check_faces(view(mesh)); });

  const Eigen::Index normals = mesh.normals.rows();
  require(normals == 0 || mesh.normals.cols() == 3, name, "normals should have 3 columns");
  if (mesh.face_normals.empty()) {
    require(normals == 0 || normals == vertices, name, "there should be a normal for each vertex, or for none");
  } else {
    require(mesh.face_normals.size() == mesh.face_vertices.size(), name, "there should be a normal for each corner");
    require(in_range(mesh.face_normals, -1, normals), name, "a normal of a corner is out of range");
  }

  for (const Mesh::FaceVarying& channel : mesh.face_varying) {
    require(channel.indices.size() == mesh.face_vertices.size(), name,
            "there should be a face-varying value for each corner");
    require(in_range(channel.indices, 0, channel.values.rows()), name,
            "a face-varying value of a corner is out of range");
    check_finite(channel.values, name, "face-varying value");
  }

  require(mesh.texture.rows() == 0 || (mesh.texture.rows() == vertices && mesh.texture.cols() == 2), name,
          "there should be two texture coordinates for each vertex, or for none");
  check_finite(mesh.texture, name, "texture coordinate");
  require(mesh.face_ids.empty() || mesh.face_ids.size() == mesh.face_sizes.size(), name,
          "there should be an id for each face, or for none");

  naming(name, [&] { check_attributes(mesh); });
  for (const Mesh::FaceNames* const names : {&mesh.groups, &mesh.objects, &mesh.materials, &mesh.smoothing_groups})
    for (const std::string& text : names->names) check_name(text, name, "name of faces");
  for (const std::string& text : mesh.material_files) check_name(text, name, "file of materials");
  for (const std::vector<Mesh::Values>* const values : {&mesh.vertex_values, &mesh.face_values})
    for (const Mesh::Values& one : *values) {
      if (one.type == ValueType::float32 || one.type == ValueType::float64) continue;
      const auto bad = std::ranges::find_if(one.values, [](double x) { return std::isnan(x); });
      if (bad != one.values.end())
        throw InvalidMesh(name + ": value '" + one.name + "' number " + format_number(bad - one.values.begin()) +
                          " is not a number, which its type, an integer, has no room for");
    }

  naming(name, [&] { check_tags(mesh); });
  for (const Mesh::KnotInterval& interval : mesh.knot_intervals) {
    require(in_range({interval.tail, interval.head}, 0, vertices), name, "a vertex of a knot interval is out of range");
    if (!std::isfinite(interval.length) || interval.length < 0)
      throw InvalidMesh(name + ": a knot interval is " + format_number(interval.length) + "; it should be positive");
  }
  check_finite(mesh.positions, name, "vertex");
  check_finite(mesh.normals, name, "normal");
}

void write_mesh(const std::filesystem::path& path, const Mesh& mesh,
                const std::function<void(std::int64_t)>& progress) {
  if (const FileFormat* const format = io_formats().writer(path, contents::meshes))
    return format->write_mesh(path, mesh, progress);
  throw InvalidOption(path.string() + ": meshes are written as " +
                      io_formats().writers_in_words({contents::meshes}, "or") + ", not as '" + file_extension(path) +
                      "'" + (without_gz(path) == path ? "" : "; compressed files are read, not written"));
}

}  // namespace sublimit
