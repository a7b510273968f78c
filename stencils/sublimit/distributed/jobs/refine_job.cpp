// SPDX-License-Identifier: Apache-2.0
#include "sublimit/distributed/jobs/refine_job.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "sublimit/base/error.h"
#include "sublimit/distributed/mesh/points_file.h"
#include "sublimit/stencils/formats/formats.h"
#include "sublimit/stencils/formats/npy.h"

namespace sublimit {
namespace {

using Run = std::array<std::int64_t, 2>;

/// So many that each rank's part at a time has no more points than this, about: some 500 MB.
int fitting_parts(const Ranks& ranks, const SpreadJob& job, int level) {
  constexpr double most = 1 << 23;
  const double points = double(ranks.sum(std::ssize(job.mesh.face_vertices))) * std::pow(4.0, level - 1);
  const double rounds = std::ceil(std::min(points / most, double(job.mesh.faces.size())) / ranks.size());
  return static_cast<int>(std::clamp(rounds, 1.0, 1e6)) * ranks.size();
}

/// Which faces of the own run are no part of the surface.
std::vector<char> holes(const Ranks& ranks, const SpreadJob& job, const SpreadShards& shards) {
  const Boundary boundary = job.rules.boundary.value_or(job.mesh.about.boundary.value_or(Boundary::edge_and_corner));
  std::vector<char> is_hole = job.incidence.is_hole;
  if (boundary != Boundary::none) return is_hole;
  // Then faces at boundaries are holes too, as a part sees that has all faces there.
  static const std::vector<std::int64_t> no_faces;
  std::vector<std::vector<std::int64_t>> to(size_t(ranks.size()));
  const std::int64_t rounds = ranks.largest(std::ssize(shards.owned));
  for (std::int64_t number = 0; number < rounds; ++number) {
    const bool is_there = number < std::ssize(shards.owned);
    const MeshPart part =
        gather_part(ranks, job.mesh, job.incidence, is_there ? shards.owned[size_t(number)] : no_faces, 2, false);
    ranks.together([&] {
      if (part.mesh.num_faces() == 0) return;
      const Level control = control_level(job.scheme, part.mesh, job.rules);
      for (size_t f = 0; f < part.faces.size(); ++f)
        if (part.is_owned[f] && control.holes[f])
          to[size_t(job.mesh.faces.rank_of(part.faces[f]))].push_back(part.faces[f]);
    });
  }
  for (const auto& from : exchange(ranks, std::move(to)))
    for (const std::int64_t f : from) is_hole[size_t(f - job.mesh.faces.begin(ranks.rank()))] = true;
  return is_hole;
}

/// Faces of the level on each face of the own run: the first one, how many.
std::vector<Run> faces_of_level(const Ranks& ranks, const SpreadJob& job, const BakeRequest& request,
                                const SpreadShards& shards) {
  const bool by_rows = shards.method == BakeMethod::rows_then_patterns;
  const std::int64_t cells = Patterns::lattice_of(job.scheme, request.level - by_rows).num_cells();
  const std::vector<char> is_hole = holes(ranks, job, shards);
  std::vector<Run> faces;
  std::int64_t sum = 0;
  for (size_t f = 0; f < is_hole.size(); ++f) {
    // Rows cut a face in one at each of its corners.
    faces.push_back({sum, is_hole[f] ? 0 : by_rows ? cells * job.mesh.face_sizes[f] : cells});
    sum += faces.back()[1];
  }
  const std::int64_t before = ranks.sum_before(sum);
  for (Run& run : faces) run[0] += before;
  return faces;
}

/// As a .ply has them.
std::vector<std::byte> in_bytes(const FaceList& faces) {
  std::vector<std::byte> bytes(faces.sizes.size() + sizeof(Index) * faces.corners.size());
  std::byte* at = bytes.data();
  const Index* corner = faces.corners.data();
  for (const Index size : faces.sizes) {
    *at++ = std::byte(size);
    std::memcpy(at, corner, size_t(size) * sizeof(Index));
    at += size_t(size) * sizeof(Index), corner += size;
  }
  return bytes;
}

}  // namespace

RefinedFile write_refined(const Ranks& ranks, const SpreadJob& job, const BakeRequest& request, Division division,
                          const std::filesystem::path& output, const Told& told) {
  ranks.together([&] { check_points_output(output); });
  const bool is_ply = all_formats().writes(output, contents::mesh_parts);
  if (division.parts == 0) division.parts = fitting_parts(ranks, job, request.level);
  told("dividing");
  Patterns patterns(job.scheme);
  int rings = 0;
  ranks.together([&] {
    check(request);
    if (is_ply) rings = shard_rings(patterns, job.creasing) + 1;
  });
  const SpreadShards shards = divide(ranks, job, patterns, request, division, rings);
  RefinedFile result{shards.num_points, 0, shards.parts};
  ranks.together([&] {
    if (is_ply && result.points > std::numeric_limits<Index>::max())
      throw InvalidOption(fmt::format(
          "{}: {} points, and the faces of a .ply count them by 32 bits; write an .npy, which has points alone",
          output.string(), result.points));
  });
  const std::int64_t begin = job.mesh.faces.begin(ranks.rank());
  std::vector<Run> faces;
  if (is_ply) {
    faces = faces_of_level(ranks, job, request, shards);
    std::int64_t own = 0;
    for (const Run& run : faces) own += run[1];
    result.faces = ranks.sum(own);
  }
  const std::string header = is_ply ? ply_header(result.points, result.faces)
                                    : npy_header(DType::F64, std::array<std::int64_t, 2>{result.points, 3});
  constexpr std::int64_t point_size = 3 * sizeof(double);
  const std::int64_t face_size = 1 + (job.scheme.face_size() == 3 ? 3 : 4) * std::int64_t{sizeof(Index)};
  const std::int64_t points_begin = std::ssize(header), faces_begin = points_begin + result.points * point_size;
  SharedFile file(ranks, output, faces_begin + result.faces * face_size);
  ranks.together([&] {
    if (ranks.is_first()) file.write(0, header);
  });
  const std::span<const double> own(job.mesh.positions.data(), size_t(job.mesh.positions.size()));
  static const std::vector<std::int64_t> no_faces;
  const std::int64_t rounds = ranks.largest(std::ssize(shards.owned));
  for (int number = 0; number < rounds; ++number) {
    told(fmt::format("refining: part {} of {} a rank", number + 1, rounds));
    const bool is_there = size_t(number) < shards.owned.size();
    FaceList list;
    Shard shard = made_shard(ranks, job, patterns, request, shards, number, is_there, is_ply ? &list : nullptr);
    if (is_ply) {
      const auto runs = fetch<Run>(ranks, job.mesh.faces, is_there ? shards.owned[size_t(number)] : no_faces,
                                   [&](std::int64_t f) { return faces[size_t(f - begin)]; });
      ranks.together([&] { write_runs(file, faces_begin, face_size, runs_of(runs), in_bytes(list)); });
      list = {};
    }
    std::vector<LoadedShard> loaded;
    if (is_there) loaded.push_back({std::move(shard.table), std::move(shard.inputs), std::move(shard.runs), {}});
    shard = {};
    const SpreadTable table(ranks, std::move(loaded), job.mesh.vertices);
    std::vector<double> points(size_t(3 * table.num_points()));
    table.apply(own, 3, points);
    ranks.together([&] {
      for (const LoadedShard& made : table.shards())
        write_runs(file, points_begin, point_size, made.runs, std::as_bytes(std::span(points)));
    });
  }
  file.commit();
  return result;
}

}  // namespace sublimit
