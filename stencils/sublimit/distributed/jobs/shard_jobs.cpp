// SPDX-License-Identifier: Apache-2.0
#include "sublimit/distributed/jobs/shard_jobs.h"

#include <fmt/core.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "sublimit/base/error.h"
#include "sublimit/distributed/mesh/division_file.h"
#include "sublimit/distributed/mesh/points_file.h"
#include "sublimit/distributed/shards/shard_faces.h"
#include "sublimit/distributed/shards/spread_frames.h"
#include "sublimit/stencils/formats/formats.h"
#include "sublimit/stencils/formats/npy.h"
#include "sublimit/stencils/formats/rule_of_word.h"

namespace sublimit {
namespace {

/// Shards of this rank, from 0.
std::vector<int> own_shards(const Ranks& ranks, int count) {
  std::vector<int> own;
  for (int number = 0; number < count; ++number)
    if (rank_of_part(ranks, number, count) == ranks.rank()) own.push_back(number);
  return own;
}

/// All that decides what is in a set of shards, but for which part has which face.
std::uint64_t bake_hash(const Ranks& ranks, const SpreadJob& job, const BakeRequest& request, const Division& division,
                        int parts) {
  std::string words =
      fmt::format("{} {} {} {} {}", job.scheme.name, int(request.rows), request.level, parts, int(division.runs));
  for (const auto& [name, value] : job.options) words += " " + name + "=" + value;
  words += fmt::format(" {} {}",
                       int(job.rules.boundary.value_or(job.mesh.about.boundary.value_or(Boundary::edge_and_corner))),
                       int(job.creasing));
  std::uint64_t hash = mesh_hash(ranks, job.mesh);
  for (const char c : words) hash = mixed(hash, std::uint64_t(c));
  return hash;
}

/// The same with it.
std::string bake_name(const Ranks& ranks, const SpreadJob& job, const std::vector<int>& part, std::uint64_t hash) {
  std::uint64_t division = 0;
  for (size_t f = 0; f < part.size(); ++f)
    division += mixed(std::uint64_t(job.mesh.faces.begin(ranks.rank())) + f, std::uint64_t(part[f]));
  return in_hexadecimal(mixed(hash, std::uint64_t(ranks.sum(std::int64_t(division)))));
}

/// Leaves what is of this bake, and nothing that it would be taken for.
void prepare(const std::filesystem::path& directory, const ShardPlace& all, bool overwrite) {
  std::filesystem::create_directories(directory);
  std::vector<std::filesystem::path> others;
  for (const auto& entry : std::filesystem::directory_iterator(directory)) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with(".shard") && name.ends_with(".tmp"))
      std::filesystem::remove(entry.path());  // of a killed bake
    if (name == shard_manifest_name && load_manifest(directory).all.bake != all.bake) others.push_back(entry.path());
    // What is no shard is somebody else's, and a damaged one is replaced when it is made again.
    const std::optional<ShardPlace> place = find_shard(entry.path());
    if (place && (place->bake != all.bake || name != shard_name(place->number, all.count)))
      others.push_back(entry.path());
  }
  if (!others.empty() && !overwrite)
    throw InvalidOption(
        fmt::format("{}: of another mesh, scheme, level or division; --overwrite removes the shards in "
                    "{}, or name another directory",
                    others.front().string(), directory.string()));
  for (const auto& other : others) std::filesystem::remove(other);
}

}  // namespace

SpreadShards divide(const Ranks& ranks, const SpreadJob& job, Patterns& patterns, const BakeRequest& request,
                    const Division& division, int rings, std::optional<std::vector<int>> part) {
  SpreadShards shards;
  ranks.together([&] {
    shards.method = shard_method(patterns, request, job.all_whole);
    shards.rings = std::max(rings, shard_rings(patterns, job.creasing));
  });
  shards.parts = division.parts > 0 ? division.parts : ranks.size();
  shards.part = part ? *std::move(part) : divided(ranks, job, division);
  shards.owned = owned_faces(ranks, job.mesh, shards.part, shards.parts);
  const std::vector<int> own = own_shards(ranks, shards.parts);
  shards.first_part = own.empty() ? 0 : own.front();
  std::int64_t sum = 0;
  for (size_t f = 0; f < job.mesh.face_sizes.size(); ++f) {
    const FaceShare face{job.mesh.face_sizes[f], job.incidence.own_sides[f], job.incidence.own_corners[f]};
    shards.points.push_back({sum, num_points(job.scheme, request, shards.method, face)});
    sum += shards.points.back()[1];
  }
  const std::int64_t before = ranks.sum_before(sum) + ranks.sum(std::ssize(job.incidence.isolated));
  for (auto& [first, count] : shards.points) first += before;
  shards.num_points = ranks.sum(sum + std::ssize(job.incidence.isolated));
  return shards;
}

Shard made_shard(const Ranks& ranks, const SpreadJob& job, Patterns& patterns, const BakeRequest& request,
                 const SpreadShards& shards, int number, bool needed, FaceList* faces) {
  static const std::vector<std::int64_t> none;
  const bool is_there = needed && size_t(number) < shards.owned.size();
  const std::vector<std::int64_t>& owned = is_there ? shards.owned[size_t(number)] : none;
  const bool isolated = is_there && shards.first_part + number == 0;
  const MeshPart part = gather_part(ranks, job.mesh, job.incidence, owned, shards.rings, isolated);
  const auto points_of = [&](const std::vector<std::int64_t>& numbers) {
    return fetch<std::array<std::int64_t, 2>>(ranks, job.mesh.faces, numbers, [&](std::int64_t f) {
      return shards.points[size_t(f - job.mesh.faces.begin(ranks.rank()))];
    });
  };
  const auto points = points_of(owned), around = faces ? points_of(part.faces) : points;
  const std::int64_t num_isolated = ranks.sum(std::ssize(job.incidence.isolated));
  if (faces) *faces = {};
  Shard shard;
  ranks.together([&] {
    if (!is_there) return;
    PartLattices lattices;
    try {
      shard = bake_shard(patterns, part, request, shards.method, job.rules, faces ? &lattices : nullptr);
    } catch (const Error& error) {  // which knows the part alone
      throw Error(error.code(), fmt::format("{}: part {} of {}, by its own numbers of vertices and faces: {}", job.name,
                                            shards.first_part + number, shards.parts, error.what()));
    }
    shard.runs = runs_of(points, isolated ? num_isolated : 0);
    std::int64_t count = 0;
    for (const PointRun& run : shard.runs) count += run.count;
    if (count != shard.table.table.num_points())
      throw AnalysisError(fmt::format("{}: part {} has {} points and should have {}", job.name,
                                      shards.first_part + number, shard.table.table.num_points(), count));
    if (faces) *faces = faces_between(std::move(lattices), part, around);
  });
  return shard;
}

ShardsMade bake_shards(const Ranks& ranks, const SpreadJob& job, const BakeRequest& request, const Division& division,
                       const std::filesystem::path& directory, bool overwrite, int rings, const Told& told) {
  Patterns patterns(job.scheme);
  told("dividing");
  const int parts = division.parts > 0 ? division.parts : ranks.size();
  const std::uint64_t hash = bake_hash(ranks, job, request, division, parts);
  const bool is_found = !division.runs && parts > 1;  // else everybody knows it
  std::optional<std::vector<int>> known;
  if (is_found) known = load_division(ranks, directory, in_hexadecimal(hash), job.mesh.faces, parts);
  const bool is_new = is_found && !known;
  const SpreadShards shards = divide(ranks, job, patterns, request, division, rings, std::move(known));
  ShardPlace all{bake_name(ranks, job, shards.part, hash), 0, parts, shards.num_points, job.mesh.vertices.size()};
  ranks.together([&] {
    if (ranks.is_first()) prepare(directory, all, overwrite);
  });
  if (is_new) save_division(ranks, directory, in_hexadecimal(hash), job.mesh.faces, shards.part);
  ShardsMade result;
  result.rings = shards.rings;
  const std::int64_t rounds = ranks.largest(std::ssize(shards.owned));
  for (int number = 0; number < rounds; ++number) {
    const int own = shards.first_part + number;
    const auto path = directory / shard_name(own, all.count);
    bool needed = size_t(number) < shards.owned.size();
    if (needed && find_shard(path)) needed = false, ++result.kept;
    if (ranks.all(!needed)) continue;
    told(fmt::format("baking: shard {} of {} a rank", number + 1, rounds));
    const Shard shard = made_shard(ranks, job, patterns, request, shards, number, needed);
    ranks.together([&] {
      if (!needed) return;
      ShardPlace place = all;
      place.number = own;
      save_shard(path, shard, place);
      ++result.made;
    });
  }
  result.made = int(ranks.sum(std::int64_t{result.made})), result.kept = int(ranks.sum(std::int64_t{result.kept}));
  result.manifest = {all, job.scheme.name, in_hexadecimal(faces_hash(ranks, job.mesh)), request.level,
                     request.rows == TableRows::limit};
  ranks.together([&] {
    if (ranks.is_first()) save_manifest(directory, result.manifest);
  });
  return result;
}

std::int64_t apply_shards(const Ranks& ranks, const std::filesystem::path& directory,
                          const std::filesystem::path& points, const std::filesystem::path& output, bool any_cage,
                          const Told& told) {
  ShardManifest manifest;
  ranks.together([&] {
    manifest = load_manifest(directory);
    check_points_output(output);
  });
  told("reading " + points.string());
  SpreadFrames frames(ranks, points);
  std::string faces = frames.mesh() ? in_hexadecimal(faces_hash(ranks, *frames.mesh())) : manifest.faces;
  if (faces != manifest.faces) {  // what was baked may have been cut into triangles first
    SpreadMesh cut = *frames.mesh();
    triangulate(ranks, cut);
    faces = in_hexadecimal(faces_hash(ranks, cut));
  }
  const bool is_ply = all_formats().writes(output, contents::mesh_parts);
  ranks.together([&] {
    if (frames.runs().size() != manifest.all.num_control_points)
      throw InvalidMesh(fmt::format("{}: {} points; {} is of a mesh of {}", points.string(), frames.runs().size(),
                                    directory.string(), manifest.all.num_control_points));
    if (faces != manifest.faces && !any_cage)
      throw InvalidMesh(
          fmt::format("{}: its faces are others than those that {} was baked from; bake again, or, if its "
                      "points are the same in the same order, give --any-cage",
                      points.string(), directory.string()));
    if (is_ply && (frames.num_channels() != 3 || frames.has_frames()))
      throw InvalidOption(output.string() + ": a .ply has one frame of x, y, z; write an .npy");
  });
  told("reading shards");
  std::vector<LoadedShard> shards;
  ranks.together([&] {
    for (const int number : own_shards(ranks, manifest.all.count))
      shards.push_back(load_shard(directory, manifest, number));
  });
  const SpreadTable table(ranks, std::move(shards), frames.runs());
  const std::int64_t num_points = manifest.all.num_points,
                     point_size = frames.num_channels() * std::int64_t{sizeof(double)};
  std::vector<std::int64_t> shape{num_points, frames.num_channels()};
  if (frames.has_frames()) shape.insert(shape.begin(), frames.num_frames());
  const std::string header = is_ply ? ply_header(num_points) : npy_header(DType::F64, shape);
  SharedFile file(ranks, output, std::ssize(header) + num_points * point_size * frames.num_frames());
  ranks.together([&] {
    if (ranks.is_first()) file.write(0, header);
  });
  for (std::int64_t frame = 0; frame < frames.num_frames(); ++frame) {
    told(fmt::format("applying: frame {} of {}", frame + 1, frames.num_frames()));
    const std::vector<double> own = frames.next();
    const std::int64_t begin = std::ssize(header) + frame * num_points * point_size;
    ranks.together([&] {
      std::exception_ptr error;  // the exchange goes on for the others
      table.apply(own, frames.num_channels(), [&](const LoadedShard& shard, std::span<const double> made) {
        try {
          if (!error) write_runs(file, begin, point_size, shard.runs, std::as_bytes(made));
        } catch (...) {
          error = std::current_exception();
        }
      });
      if (error) std::rethrow_exception(error);
    });
  }
  file.commit();
  return frames.num_frames();
}

std::vector<std::string> verify_shards(const Ranks& ranks, const std::filesystem::path& directory, const Told& told) {
  ShardManifest manifest;
  ranks.together([&] { manifest = load_manifest(directory); });
  std::string faults;
  const auto fault = [&](const std::string& what) { faults += what + "\n"; };
  // Runs of points are looked at where the points would be in equal runs: any two that meet, meet there.
  const Runs homes = Runs::equal(manifest.all.num_points, ranks.size());
  std::vector<std::vector<PointRun>> to(size_t(ranks.size()));
  for (const int number : own_shards(ranks, manifest.all.count)) {
    told(fmt::format("reading shard {} of {}", number + 1, manifest.all.count));
    const auto path = directory / shard_name(number, manifest.all.count);
    try {
      std::error_code ignored;
      if (!std::filesystem::exists(path, ignored)) {
        fault(path.string() + ": missing; bake again, which makes what is missing");
        continue;
      }
      for (PointRun run : load_shard(directory, manifest, number).runs)
        while (run.count > 0) {
          const int home = homes.rank_of(run.first);
          const std::int64_t here = std::min(run.count, homes.begin(home) + homes.size(home) - run.first);
          to[size_t(home)].push_back({run.first, here});
          run.first += here, run.count -= here;
        }
    } catch (const Error& error) {
      fault(error.what());
    }
  }
  std::vector<PointRun> runs;
  for (const auto& from : exchange(ranks, std::move(to))) runs.insert(runs.end(), from.begin(), from.end());
  std::ranges::sort(runs, {}, &PointRun::first);
  std::int64_t next = homes.begin(ranks.rank());
  const auto points = [](std::int64_t begin, std::int64_t end) {
    return fmt::format("points {} to {}", begin, end - 1);
  };
  for (const PointRun& run : runs) {
    if (run.first > next) fault(fmt::format("{}: {} are in no shard", directory.string(), points(next, run.first)));
    if (run.first < next)
      fault(fmt::format("{}: {} are in two shards", directory.string(),
                        points(run.first, std::min(next, run.first + run.count))));
    next = std::max(next, run.first + run.count);
  }
  const std::int64_t end = homes.begin(ranks.rank()) + homes.size(ranks.rank());
  if (next < end) fault(fmt::format("{}: {} are in no shard", directory.string(), points(next, end)));
  if (ranks.is_first())
    for (const auto& entry : std::filesystem::directory_iterator(directory)) {
      const std::string name = entry.path().filename().string();
      const std::optional<ShardPlace> place = find_shard(entry.path());
      if (place && (place->count != manifest.all.count || name != shard_name(place->number, manifest.all.count)))
        fault(entry.path().string() + ": a shard of another set; it does no harm, and is of no use");
    }
  std::vector<std::vector<char>> texts(size_t(ranks.size()));
  texts[0].assign(faults.begin(), faults.end());
  std::vector<std::string> all;
  for (const auto& text : exchange(ranks, std::move(texts))) {
    std::string line;
    for (const char c : text)
      if (c == '\n')
        all.push_back(std::exchange(line, {}));
      else
        line += c;
  }
  return all;
}

}  // namespace sublimit
