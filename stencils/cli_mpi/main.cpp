// SPDX-License-Identifier: Apache-2.0
// `sublimit-mpi`: tables of one mesh by many processes.
#include <fmt/core.h>
#include <mpi.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numeric>

#include "sublimit/base/error.h"
#include "sublimit/distributed/ranks.h"
#include "sublimit/files/npy.h"
#include "sublimit/io/read_mesh.h"
#include "sublimit/jobs/mesh_job.h"
#include "sublimit/shards/shard_file.h"

namespace sublimit {
namespace {

struct Options {
  std::string mesh, scheme, output, shards;
  int levels = 0;
};

/// Faces in equal runs.
std::vector<int> equal_runs(Index faces, int parts) {
  std::vector<int> owner(static_cast<size_t>(faces));
  for (Index f = 0; f < faces; ++f) owner[size_t(f)] = static_cast<int>(std::int64_t{f} * parts / faces);
  return owner;
}

void bake_shards(const Options& options, const Ranks& ranks) {
  MeshRequest request;
  request.scheme = options.scheme;
  const MeshJob job = mesh_job(request, read_mesh(options.mesh), options.mesh);
  Patterns patterns(*job.scheme);
  const Topology topology(view(job.mesh));
  const std::vector<int> owner = equal_runs(job.mesh.num_faces(), ranks.size());
  const int rings = shard_rings(patterns, control_level(*job.scheme, job.mesh, job.rules));
  const MeshPart part = mesh_part(job.mesh, topology, owner, ranks.rank(), rings);
  const Shard shard = bake_shard(patterns, part, {.rows = TableRows::level, .level = options.levels}, job.rules);
  const std::int64_t own = shard.table.table.num_points();
  const ShardPlace place{ranks.rank(), ranks.size(), ranks.sum_before(own), ranks.sum(own), job.mesh.num_vertices()};
  if (ranks.rank() == 0) std::filesystem::create_directories(options.output);
  ranks.wait();
  save_shard(std::filesystem::path(options.output) / shard_name(place.number, place.count), shard, place);
  ranks.wait();
  if (ranks.rank() > 0) return;
  const nlohmann::ordered_json manifest{{"format", "sublimit-shards"}, {"shards", place.count},
                                        {"points", place.num_points},  {"control_points", place.num_control_points},
                                        {"scheme", job.scheme->name},  {"level", options.levels}};
  write_whole(std::filesystem::path(options.output) / "shards.json", manifest.dump(2) + "\n");
  fmt::print("{}: {} points in {} shards\n", options.output, place.num_points, place.count);
}

void apply_shards(const Options& options, const Ranks& ranks) {
  const std::filesystem::path directory = options.shards;
  std::ifstream in(directory / "shards.json");
  if (!in)
    throw IoError((directory / "shards.json").string() +
                  ": cannot read; it is written when all shards are there, so bake them first");
  const nlohmann::json manifest = nlohmann::json::parse(in, nullptr, false);
  if (manifest.is_discarded() || manifest.value("format", "") != "sublimit-shards")
    throw FormatError((directory / "shards.json").string() + ": no manifest of shards");
  const int count = manifest.at("shards");
  const std::int64_t points = manifest.at("points"), control_points = manifest.at("control_points");
  const Points x = read_mesh(options.mesh).positions;
  if (x.rows() != control_points)
    throw InvalidMesh(
        fmt::format("{}: {} points; the shards are of a mesh of {}", options.mesh, x.rows(), control_points));
  const std::int64_t shape[] = {points, 3};
  const std::string header = npy_header(DType::F64, shape);
  SharedFile out(ranks, options.output);
  if (ranks.rank() == 0) out.write(0, header.data(), header.size());
  for (int number = ranks.rank(); number < count; number += ranks.size()) {
    const LoadedShard shard = load_shard(directory / shard_name(number, count));
    std::vector<double> from, made(size_t(3 * shard.table.table.num_points()));
    for (const std::int64_t v : shard.inputs)
      for (Eigen::Index k = 0; k < 3; ++k) from.push_back(x(v, k));
    shard.table.table.apply(from, 3, made);
    out.write(std::int64_t(header.size()) + 24 * shard.place.first_point, made.data(), made.size() * sizeof(double));
  }
  out.commit();
  if (ranks.rank() == 0) fmt::print("{}: {} points\n", options.output, points);
}

}  // namespace
}  // namespace sublimit

int main(int argc, char** argv) {
  const sublimit::Ranks ranks(argc, argv);
  CLI::App app("Tables of one mesh by many processes: mpirun -n N sublimit-mpi ...");
  app.require_subcommand(1);
  sublimit::Options options;
  CLI::App* const bake = app.add_subcommand("bake", "A directory of shards, one a rank");
  bake->add_option("MESH", options.mesh)->required();
  bake->add_option("-s,--scheme", options.scheme)->required();
  bake->add_option("-l,--levels", options.levels)->required();
  bake->add_option("-o,--output", options.output, "DIR")->required();
  CLI::App* const apply = app.add_subcommand("apply", "Points of a pose, by any number of ranks");
  apply->add_option("SHARDS", options.shards, "DIR of a bake")->required();
  apply->add_option("MESH", options.mesh)->required();
  apply->add_option("-o,--output", options.output, "OUT.npy")->required();
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    const int status = ranks.rank() == 0 ? app.exit(error) : int(error.get_exit_code());
    return status == 0 ? 0 : 2;
  }
  return ranks.run([&] { (bake->parsed() ? sublimit::bake_shards : sublimit::apply_shards)(options, ranks); });
}
