// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>
#include <tbb/global_control.h>
#include <unistd.h>

#include "../cli/support/memory_limit.h"
#include "commands.h"
#include "sublimit/base/detail/rule_words.h"
#include "sublimit/base/error.h"
#include "sublimit/stencils/files/rule_of_word.h"

namespace sublimit::cli_mpi {

void add_run(CLI::App& command, Common& common) {
  command.add_option("--threads", common.threads, "Of each rank (default 1: a rank a core)")
      ->check(CLI::Range(1, 4096));
  cli::add_memory_limit(command, common.memory_limit);
  command.add_flag("-q,--quiet", common.quiet, "No progress, no summary");
}

void add_mesh(CLI::App& command, Common& common) {
  MeshRequest& request = common.request;
  command
      .add_option("MESH", common.mesh,
                  "Control mesh: .obj (with tags), binary .ply, or .safetensors with positions, face_vertices[, "
                  "face_sizes, creases, crease_sharpness, corners, corner_sharpness, holes]; MESH.json beside it "
                  "overrides tags")
      ->required();
  command.add_option("-s,--scheme", request.scheme, "Scheme (see `sublimit schemes`)")->required();
  command.add_option("--boundary", request.boundary, "Boundary rule (default: the file's tag, else edge-and-corner)");
  command.add_option("--creasing", request.creasing, "How sharpness decays (default: the file's tag, else uniform)");
  command.add_option("--triangles", request.triangles,
                     "Catmull-Clark next to triangles (default: the file's tag, else catmark)");
  command.add_option("--option", common.options, "An option of the scheme, name=value; may be repeated")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  command.add_flag("--triangulate", request.triangulate,
                   "First cut every face into triangles, a fan from its first corner; tags are kept");
  command.add_flag("--no-creases", request.no_creases, "First drop the crease and corner tags");
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
  static std::unique_ptr<tbb::global_control> threads;
  threads = std::make_unique<tbb::global_control>(tbb::global_control::max_allowed_parallelism, common.threads);
  if (!ranks.is_first() || common.quiet || !::isatty(STDERR_FILENO)) return [](const std::string&) {};
  return [](const std::string& what) { fmt::print(stderr, "sublimit-mpi: {} ...\n", what); };
}

MeshRequest checked_request(const Ranks& ranks, const Common& common) {
  MeshRequest request = common.request;
  ranks.together([&] {
    for (const std::string& text : common.options) {
      const size_t equals = text.find('=');
      if (equals == std::string::npos || equals == 0)
        throw InvalidOption("--option " + text + ": write it as name=value");
      request.options[text.substr(0, equals)] = text.substr(equals + 1);
    }
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
