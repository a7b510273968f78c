// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>
#include <unistd.h>

#include "../cli/support/memory_limit.h"
#include "../cli/support/mesh_options.h"
#include "commands.h"

namespace sublimit::cli_mpi {

void add_run(CLI::App& command, Common& common) {
  command.add_option("--threads", common.threads, "Of each rank (default 1: a rank a core)")
      ->check(CLI::Range(1, 4096));
  cli::add_memory_limit(command, common.memory_limit);
  command.add_flag("-q,--quiet", common.quiet, "No progress, no summary");
}

void add_mesh(CLI::App& command, Common& common) {
  MeshRequest& request = common.request;
  cli::add_mesh_options(
      command,
      {common.mesh, request.scheme, request.boundary, request.creasing, request.triangles, nullptr, common.options,
       request.triangulate, request.no_creases},
      ".obj (with tags), binary .ply, or .safetensors with positions, face_vertices[, face_sizes, creases, "
      "crease_sharpness, corners, corner_sharpness, holes]",
      true);
  add_run(command, common);
}

Levels Levels::resolved() const {
  Levels levels = *this;
  levels.request.rows = limit ? TableRows::limit : TableRows::level;
  levels.division.runs = partition == "runs";
  return levels;
}

void add_levels(CLI::App& command, Levels& levels) {
  command.add_option("-l,--levels", levels.request.level, "Level: 1 to 11, with --limit from 0")->required();
  command.add_flag("--limit", levels.limit, "The limit of the level's vertices, instead of the level");
  command.add_option("--partition", levels.partition, "scotch: few neighbours elsewhere; runs: faces as they stand")
      ->check(CLI::IsMember({"scotch", "runs"}));
}

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

Told begin(const Ranks& ranks, const Common& common) {
  ranks.together([&] { cli::limit_memory(common.memory_limit); });
  cli::limit_threads(common.threads);
  if (!ranks.is_first() || common.quiet || !::isatty(STDERR_FILENO)) return [](const std::string&) {};
  return [](const std::string& what) { fmt::print(stderr, "sublimit-mpi: {} ...\n", what); };
}

MeshRequest checked_request(const Ranks& ranks, const Common& common) {
  MeshRequest request = common.request;
  ranks.together([&] {
    request.options = cli::scheme_options(common.options);
    if (!request.triangles.empty()) request.options["triangles"] = request.triangles;
    scheme_job(request);
  });
  return request;
}

SpreadJob load(const Ranks& ranks, const Common& common, const Told& told) {
  const MeshRequest request = checked_request(ranks, common);
  told("reading " + common.mesh);
  SpreadMesh mesh = read_spread_mesh(ranks, common.mesh);
  SpreadJob job = spread_job(ranks, request, std::move(mesh), common.mesh);
  if (!common.quiet && ranks.is_first())
    for (const std::string& warning : job.mesh.about.warnings)
      fmt::print(stderr, "sublimit-mpi: warning: {}\n", warning);
  return job;
}

}  // namespace sublimit::cli_mpi
