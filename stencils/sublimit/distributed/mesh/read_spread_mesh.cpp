// SPDX-License-Identifier: Apache-2.0
// Meshes from files, each rank from its own bytes. Files are mapped: what a rank does not look at it does not have.
#include <fmt/core.h>

#include <algorithm>
#include <limits>

#include "sublimit/base/detail/mapped_file.h"
#include "sublimit/base/detail/memory.h"
#include "sublimit/base/error.h"
#include "sublimit/distributed/mesh/spread_readers.h"
#include "sublimit/stencils/formats/formats.h"
#include "sublimit/stencils/formats/sidecar.h"

namespace sublimit {
namespace {

std::string_view text_of(std::span<const std::byte> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

/// Tags that lie beside the file take the place of its own of their kind.
void read_sidecar(const Ranks& ranks, const std::filesystem::path& path, SpreadMesh& mesh) {
  const std::optional<std::filesystem::path> sidecar = find_sidecar(path);
  const bool is_there = !ranks.all(!sidecar);
  if (!is_there) return;
  Mesh tags;  // marked, to see what the sidecar leaves alone
  tags.creases = {{-1, -1, 0}}, tags.corners = {{-1, 0}}, tags.holes = {-1};
  ranks.together([&] {
    if (!sidecar) throw IoError(path.string() + ": a sidecar that other ranks see is missing here");
    constexpr std::int64_t most = std::numeric_limits<Index>::max();
    apply_sidecar_text(tags, sidecar_text(*sidecar), sidecar->string(),
                       MeshCounts{static_cast<Index>(std::min(most, mesh.vertices.size())),
                                  static_cast<Index>(std::min(most, mesh.faces.size()))});
    if (!tags.knot_intervals.empty())
      throw InvalidMesh(sidecar->string() +
                        ": knot intervals are those of strips of faces, which no part sees to their ends");
  });
  const auto is_kept = [](const auto& list, Index first) { return list.size() == 1 && first < 0; };
  if (!is_kept(tags.creases, tags.creases.empty() ? 0 : tags.creases[0].tail)) {
    mesh.creases.clear();
    for (const auto& [tail, head, sharpness] : tags.creases)
      if (ranks.is_first()) mesh.creases.push_back({tail, head, sharpness, std::ssize(mesh.creases)});
  }
  if (!is_kept(tags.corners, tags.corners.empty() ? 0 : tags.corners[0].vertex)) {
    mesh.corners.clear();
    for (const auto& [vertex, sharpness] : tags.corners)
      if (ranks.is_first()) mesh.corners.push_back({vertex, sharpness, std::ssize(mesh.corners)});
  }
  if (!is_kept(tags.holes, tags.holes.empty() ? 0 : tags.holes[0])) {
    mesh.holes.clear();
    if (ranks.is_first()) mesh.holes.assign(tags.holes.begin(), tags.holes.end());
  }
  if (tags.boundary) mesh.about.boundary = tags.boundary;
  if (tags.creasing) mesh.about.creasing = tags.creasing;
  if (tags.triangles) mesh.about.triangles = tags.triangles;
  if (tags.face_varying_interpolation) mesh.about.face_varying_interpolation = tags.face_varying_interpolation;
  if (ranks.is_first())
    mesh.about.warnings.insert(mesh.about.warnings.end(), tags.warnings.begin(), tags.warnings.end());
}

}  // namespace

void check_room(const Ranks& ranks, double faces, const std::string& name) {
  constexpr double bytes_of_face = 465;  // measured: read and connected (bench/distributed)
  check_memory(fmt::format("{}: {:.0f} faces, of {} ranks the {} on this machine,", name, faces, ranks.size(),
                           ranks.on_this_machine()),
               bytes_of_face * faces / ranks.size() * ranks.on_this_machine(), "use more machines");
}

void take_tags(const Ranks& ranks, const Mesh& from, SpreadMesh& mesh) {
  std::int64_t number = ranks.sum_before(std::ssize(from.creases) + std::ssize(from.corners));
  for (const auto& [tail, head, sharpness] : from.creases) mesh.creases.push_back({tail, head, sharpness, number++});
  for (const auto& [vertex, sharpness] : from.corners) mesh.corners.push_back({vertex, sharpness, number++});
  mesh.holes.assign(from.holes.begin(), from.holes.end());
  mesh.about.warnings = from.warnings;
  mesh.about.boundary = from.boundary, mesh.about.creasing = from.creasing, mesh.about.triangles = from.triangles;
  mesh.about.face_varying_interpolation = from.face_varying_interpolation;
}

SpreadMesh read_spread_mesh(const Ranks& ranks, const std::filesystem::path& path) {
  const std::string name = path.string();
  MappedFile file;
  ranks.together([&] {
    file = map_file(path);
    if (!all_formats().reads(path, contents::mesh_parts))
      throw FormatError(name + ": unknown kind of mesh '" + file_extension(path) + "'; " +
                        all_formats().readers_in_words({contents::mesh_parts}, "and") + " can be read");
  });
  check_alike(ranks, std::to_string(file.bytes.size()), "bytes in " + name);
  // Three formats have parts of meshes: the one that tables are in too, the one with values at vertices, and OBJ.
  SpreadMesh mesh = all_formats().reads(path, contents::tables) ? read_tensor_parts(ranks, file.bytes, name)
                    : all_formats().reads(path, contents::vertex_values)
                        ? read_ply_parts(ranks, text_of(file.bytes), name)
                        : read_obj_parts(ranks, text_of(file.bytes), name);
  read_sidecar(ranks, path, mesh);
  check(ranks, mesh, name);
  return mesh;
}

SpreadMesh spread(const Ranks& ranks, const Mesh& whole) {
  SpreadMesh mesh;
  const bool first = ranks.is_first();
  mesh.vertices = Runs(ranks, first ? whole.num_vertices() : 0);
  mesh.faces = Runs(ranks, first ? whole.num_faces() : 0);
  mesh.positions.resize(0, 3);
  if (first) {
    mesh.positions = whole.positions;
    mesh.face_sizes = whole.face_sizes;
    mesh.face_vertices.assign(whole.face_vertices.begin(), whole.face_vertices.end());
  }
  take_tags(ranks, first ? whole : Mesh{}, mesh);
  return mesh;
}

void triangulate(const Ranks& ranks, SpreadMesh& mesh) {
  std::vector<std::int64_t> first{0}, corners, values;
  const std::int64_t* corner = mesh.face_vertices.data();
  const std::int64_t* value = mesh.face_varying ? mesh.face_varying->indices.data() : nullptr;
  for (const std::int32_t size : mesh.face_sizes) {
    for (std::int32_t k = 1; k + 1 < size; ++k) {
      corners.insert(corners.end(), {corner[0], corner[k], corner[k + 1]});
      if (value) values.insert(values.end(), {value[0], value[k], value[k + 1]});
    }
    first.push_back(first.back() + size - 2);
    corner += size;
    if (value) value += size;
  }
  std::vector<std::vector<std::int64_t>> holes(size_t(ranks.size()));
  for (const std::int64_t f : mesh.holes)
    holes[size_t(mesh.faces.rank_of(f))].push_back(f - mesh.faces.begin(mesh.faces.rank_of(f)));
  mesh.face_sizes.assign(corners.size() / 3, 3);
  mesh.face_vertices = std::move(corners);
  if (value) mesh.face_varying->indices = std::move(values);
  mesh.faces = Runs(ranks, std::ssize(mesh.face_sizes));
  mesh.holes.clear();
  for (const auto& from : exchange(ranks, std::move(holes)))
    for (const std::int64_t f : from)
      for (std::int64_t t = first[size_t(f)]; t < first[size_t(f) + 1]; ++t)
        mesh.holes.push_back(mesh.faces.begin(ranks.rank()) + t);
}

void check(const Ranks& ranks, const SpreadMesh& mesh, const std::string& name) {
  ranks.together([&] {
    const std::int64_t vertices = mesh.vertices.size(), faces = mesh.faces.size();
    if (vertices == 0) throw InvalidMesh(name + ": no vertices");
    if (faces == 0) throw InvalidMesh(name + ": no faces");
    const auto require = [&](std::int64_t id, std::int64_t count, const std::string& what, const char* are) {
      if (id < 0 || id >= count)
        throw InvalidMesh(
            fmt::format("{}: {} {} is out of range; there are {}, 0 to {}", name, what, id, count, count - 1, are));
    };
    size_t at = 0;
    for (size_t f = 0; f < mesh.face_sizes.size(); ++f)
      for (std::int32_t k = 0; k < mesh.face_sizes[f]; ++k) {
        const std::int64_t v = mesh.face_vertices[at++];
        if (v < 0 || v >= vertices)
          require(v, vertices, fmt::format("vertex of face {}:", mesh.faces.begin(ranks.rank()) + std::int64_t(f)), "");
      }
    for (const SpreadMesh::Crease& crease : mesh.creases)
      for (const std::int64_t v : {crease.tail, crease.head}) require(v, vertices, "vertex of a crease:", "");
    for (const SpreadMesh::Corner& corner : mesh.corners) require(corner.vertex, vertices, "vertex of a corner:", "");
    for (const std::int64_t f : mesh.holes) require(f, faces, "hole: face", "");
  });
}

}  // namespace sublimit
