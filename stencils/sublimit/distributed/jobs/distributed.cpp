// SPDX-License-Identifier: Apache-2.0
#include "sublimit/distributed/distributed.h"

#include <fmt/core.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

#include "sublimit/base/error.h"
#include "sublimit/distributed/jobs/shard_jobs.h"
#include "sublimit/distributed/mesh/spread_readers.h"
#include "sublimit/mesh/detail/check_mesh.h"

namespace sublimit {
namespace {

/// Checks the arrays and tags of a rank by themselves; `check` looks at the numbers in them.
/// @param where  what messages begin with
/// @param first_vertex, first_face  numbers in the whole
void check_run(const std::string& where, const MeshRun& run, std::int64_t first_vertex, std::int64_t first_face) {
  if (run.positions.rows() > 0 && run.positions.cols() != 3)
    throw InvalidMesh(fmt::format("{}: positions have {} columns; 3 are right", where, run.positions.cols()));
  for (Eigen::Index v = 0; v < run.positions.rows(); ++v)
    if (!run.positions.row(v).allFinite())
      throw InvalidMesh(fmt::format("{}: coordinates of vertex {} are not finite", where, first_vertex + v));
  std::int64_t corners = 0;
  for (size_t f = 0; f < run.face_sizes.size(); ++f) {
    if (run.face_sizes[f] < 3)
      throw InvalidMesh(fmt::format("{}: face {} has {} corners; it should have at least 3", where,
                                    first_face + std::int64_t(f), run.face_sizes[f]));
    corners += run.face_sizes[f];
  }
  if (corners != std::ssize(run.face_vertices))
    throw InvalidMesh(fmt::format("{}: the face sizes add up to {} corners, but there are {}", where, corners,
                                  run.face_vertices.size()));
  for (const MeshRun::Crease& crease : run.creases)
    if (!(crease.sharpness >= 0))
      throw InvalidMesh(fmt::format("{}: a crease from vertex {} to {} has sharpness {}; it should be 0 or more", where,
                                    crease.tail, crease.head, crease.sharpness));
  for (const MeshRun::Corner& corner : run.corners)
    if (!(corner.sharpness >= 0))
      throw InvalidMesh(fmt::format("{}: a corner at vertex {} has sharpness {}; it should be 0 or more", where,
                                    corner.vertex, corner.sharpness));
}

template <class Rule>
char letter(const std::optional<Rule>& rule) {
  return rule ? char('0' + int(*rule)) : '-';
}
template <class Rule>
std::optional<Rule> rule_of_letter(char letter) {
  return letter == '-' ? std::nullopt : std::optional(Rule(letter - '0'));
}

SpreadMesh spread_of(const Ranks& ranks, MeshRun run) {
  SpreadMesh mesh;
  mesh.vertices = Runs(ranks, run.positions.rows());
  mesh.faces = Runs(ranks, std::ssize(run.face_sizes));
  ranks.together([&] {
    check_run(fmt::format("{}: rank {}", run.name, ranks.rank()), run, mesh.vertices.begin(ranks.rank()),
              mesh.faces.begin(ranks.rank()));
    check_room(ranks, double(mesh.faces.size()), run.name);
  });
  mesh.positions = std::move(run.positions);
  if (mesh.positions.rows() == 0) mesh.positions.resize(0, 3);
  mesh.face_sizes = std::move(run.face_sizes), mesh.face_vertices = std::move(run.face_vertices);
  std::int64_t number = ranks.sum_before(std::ssize(run.creases) + std::ssize(run.corners));
  for (const auto& [tail, head, sharpness] : run.creases) mesh.creases.push_back({tail, head, sharpness, number++});
  for (const auto& [vertex, sharpness] : run.corners) mesh.corners.push_back({vertex, sharpness, number++});
  mesh.holes = std::move(run.holes);
  // A part has the rules of the mesh, whichever rank bakes it.
  const std::string rules = ranks.told_by_first({letter(run.boundary), letter(run.creasing), letter(run.triangles)});
  mesh.about.boundary = rule_of_letter<Boundary>(rules[0]);
  mesh.about.creasing = rule_of_letter<Creasing>(rules[1]);
  mesh.about.triangles = rule_of_letter<Triangles>(rules[2]);
  check(ranks, mesh, run.name);
  return mesh;
}

/// Scheme and options in words, to be compared between ranks.
std::string words(const AnyScheme& scheme, const DistributedBakeOptions& options) {
  std::string words = scheme->name;
  for (const auto& [name, value] : scheme->chosen) words += " " + name + "=" + value;
  words += fmt::format(", {} {}", options.limit ? "limit of level" : "level", options.levels);
  words += options.partition == Partition::as_given ? ", as given" : ", few neighbours";
  return words + (options.faces ? ", with faces" : "");
}

}  // namespace

struct DistributedTable::State {
  State(const Ranks& all, std::vector<LoadedShard> shards, const Runs& control_points, std::int64_t points,
        FaceList between = {})
      : ranks(all), table(all, std::move(shards), control_points), all_points(points), faces(std::move(between)) {}

  /// @throws InvalidParameter  on all ranks
  void check_sizes(size_t own, size_t points, int channels) const {
    std::string wrong;
    const auto require = [&](size_t size, std::int64_t rows, const char* what) {
      if (wrong.empty() && size != size_t(rows) * size_t(channels))
        wrong = fmt::format("rank {}: {} numbers for {} {} of {} channels; {} are right", ranks.rank(), size, rows,
                            what, channels, size_t(rows) * size_t(channels));
    };
    if (channels < 1) wrong = fmt::format("rank {}: {} channels; 1 or more are right", ranks.rank(), channels);
    require(own, table.halo().num_own(), "control points");
    require(points, table.num_points(), "points");
    const std::int64_t said = wrong.empty() ? channels : 0, most = ranks.largest(said), least = -ranks.largest(-said);
    if (least == most && least > 0) return;
    ranks.together([&] {
      if (!wrong.empty()) throw InvalidParameter(wrong);
    });
    ranks.together(
        [&] { throw InvalidParameter(fmt::format("{} to {} channels; all ranks should have as many", least, most)); });
  }

  const Ranks& ranks;
  SpreadTable table;
  std::int64_t all_points = 0;
  FaceList faces;
};

DistributedTable::DistributedTable(std::shared_ptr<const State> state) : state_(std::move(state)) {}

std::int64_t DistributedTable::num_control_points() const { return state_->table.halo().num_own(); }
std::int64_t DistributedTable::first_control_point() const {
  return state_->table.control_points().begin(state_->ranks.rank());
}
std::int64_t DistributedTable::all_control_points() const { return state_->table.control_points().size(); }
std::int64_t DistributedTable::num_points() const { return state_->table.num_points(); }
std::int64_t DistributedTable::all_points() const { return state_->all_points; }
size_t DistributedTable::num_results(int channels) const {
  return size_t(num_points()) * size_t(std::max(channels, 0));
}
std::vector<std::int64_t> DistributedTable::point_numbers() const {
  std::vector<std::int64_t> numbers;
  numbers.reserve(size_t(num_points()));
  for (const LoadedShard& shard : state_->table.shards())
    for (const PointRun& run : shard.runs)
      for (std::int64_t i = 0; i < run.count; ++i) numbers.push_back(run.first + i);
  return numbers;
}
const FaceList& DistributedTable::faces() const { return state_->faces; }
std::int64_t DistributedTable::num_remote_control_points() const { return state_->table.halo().num_remote(); }

void DistributedTable::apply(std::span<const double> own, int channels, std::span<double> points) const {
  state_->check_sizes(own.size(), points.size(), channels);
  state_->table.apply(own, channels, points);
}

void DistributedTable::apply_transpose(std::span<const double> points, int channels, std::span<double> own) const {
  state_->check_sizes(own.size(), points.size(), channels);
  state_->table.apply_transpose(points, channels, own);
}

MeshRun read_mesh_run(const Ranks& ranks, const std::filesystem::path& path) {
  SpreadMesh mesh = read_spread_mesh(ranks, path);
  MeshRun run;
  run.positions = std::move(mesh.positions);
  run.face_sizes = std::move(mesh.face_sizes), run.face_vertices = std::move(mesh.face_vertices);
  for (const SpreadMesh::Crease& crease : mesh.creases)
    run.creases.push_back({crease.tail, crease.head, crease.sharpness});
  for (const SpreadMesh::Corner& corner : mesh.corners) run.corners.push_back({corner.vertex, corner.sharpness});
  run.holes = std::move(mesh.holes);
  run.boundary = mesh.about.boundary, run.creasing = mesh.about.creasing, run.triangles = mesh.about.triangles;
  run.name = path.string(), run.warnings = std::move(mesh.about.warnings);
  return run;
}

MeshRun mesh_run(const Mesh& whole, int rank, int size) {
  if (rank < 0 || rank >= size)
    throw InvalidParameter(fmt::format("run {} of {}; 0 to {} are right", rank, size, size - 1));
  if (!whole.knot_intervals.empty())
    throw InvalidMesh("knot intervals are those of strips of faces, which no part sees to their ends");
  check_faces(view(whole));
  const Runs vertices = Runs::equal(whole.num_vertices(), size), faces = Runs::equal(whole.num_faces(), size);
  MeshRun run;
  run.positions = whole.positions.middleRows(vertices.begin(rank), vertices.size(rank));
  const auto first = whole.face_sizes.begin() + faces.begin(rank), last = first + faces.size(rank);
  run.face_sizes.assign(first, last);
  const auto corner = whole.face_vertices.begin() + std::accumulate(whole.face_sizes.begin(), first, std::ptrdiff_t{0});
  run.face_vertices.assign(corner, corner + std::accumulate(first, last, std::ptrdiff_t{0}));
  run.boundary = whole.boundary, run.creasing = whole.creasing, run.triangles = whole.triangles;
  if (rank > 0) return run;
  for (const auto& [tail, head, sharpness] : whole.creases) run.creases.push_back({tail, head, sharpness});
  for (const auto& [vertex, sharpness] : whole.corners) run.corners.push_back({vertex, sharpness});
  run.holes.assign(whole.holes.begin(), whole.holes.end());
  run.warnings = whole.warnings;
  return run;
}

DistributedTable bake(const Ranks& ranks, MeshRun mesh, const AnyScheme& scheme,
                      const DistributedBakeOptions& options) {
  check_alike(ranks, words(scheme, options), "scheme or options");
  const BakeRequest request{.rows = options.limit ? TableRows::limit : TableRows::level, .level = options.levels};
  ranks.together([&] { check(request); });
  const std::string name = mesh.name;
  SpreadMesh spread = spread_of(ranks, std::move(mesh));
  MeshRequest refined;
  refined.own_scheme = std::make_shared<const Scheme<double>>(*scheme.for_mesh(spread.about));
  const SpreadJob job = spread_job(ranks, refined, std::move(spread), name);
  Patterns patterns(job.scheme);
  int rings = 0;
  std::optional<std::vector<int>> part;
  ranks.together([&] {
    // Faces between points need those of the faces beside their part.
    if (options.faces) rings = shard_rings(patterns, job.creasing) + 1;
    if (options.partition == Partition::as_given) part.emplace(job.mesh.face_sizes.size(), ranks.rank());
  });
  const SpreadShards shards = divide(ranks, job, patterns, request, {}, rings, std::move(part));
  ranks.together([&] {
    if (options.faces && shards.num_points > std::numeric_limits<Index>::max())
      throw ResourceError(
          fmt::format("{}: {} points, and faces count them by 32 bits; ask for points alone", name, shards.num_points));
  });
  FaceList faces;
  Shard shard = made_shard(ranks, job, patterns, request, shards, 0, true, options.faces ? &faces : nullptr);
  std::vector<LoadedShard> own;
  own.push_back({std::move(shard.table), std::move(shard.inputs), std::move(shard.runs), {}});
  return DistributedTable(std::make_shared<const DistributedTable::State>(ranks, std::move(own), job.mesh.vertices,
                                                                          shards.num_points, std::move(faces)));
}

DistributedTable load(const Ranks& ranks, const std::filesystem::path& directory, std::int64_t num_control_points) {
  ShardManifest manifest;
  ranks.together([&] {
    if (num_control_points < 0)
      throw InvalidParameter(fmt::format("rank {}: {} control points", ranks.rank(), num_control_points));
    manifest = load_manifest(directory);
  });
  const Runs runs(ranks, num_control_points);
  std::vector<LoadedShard> own;
  ranks.together([&] {
    if (runs.size() != manifest.all.num_control_points)
      throw InvalidParameter(fmt::format("{} control points on all ranks; {} is of a mesh of {}", runs.size(),
                                         directory.string(), manifest.all.num_control_points));
    for (int number = 0; number < manifest.all.count; ++number)
      if (rank_of_part(ranks, number, manifest.all.count) == ranks.rank())
        own.push_back(load_shard(directory, manifest, number));
  });
  return DistributedTable(
      std::make_shared<const DistributedTable::State>(ranks, std::move(own), runs, manifest.all.num_points));
}

}  // namespace sublimit
