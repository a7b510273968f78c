// SPDX-License-Identifier: Apache-2.0
// refine: a level or its limit into one file.
#include <fmt/core.h>

#include "commands.h"
#include "sublimit/distributed/jobs/refine_job.h"

namespace sublimit::cli_mpi {
namespace {

struct RefineOptions {
  Common common;
  Levels levels;
  std::string output;
};

void refine(const Ranks& ranks, const RefineOptions& options) {
  const auto start = std::chrono::steady_clock::now();
  const Told told = begin(ranks, options.common);
  const SpreadJob job = load(ranks, options.common, told);
  const Levels levels = options.levels.resolved();
  const RefinedFile made = write_refined(ranks, job, levels.request, levels.division, options.output, told);
  if (!ranks.is_first() || options.common.quiet) return;
  fmt::print("{}: {} points{}, in {} parts; {:.3f} s\n", options.output, made.points,
             made.faces > 0 ? fmt::format(", {} faces", made.faces) : "", made.parts, seconds_since(start));
}

}  // namespace

void add_refine(CLI::App& app, Command& chosen) {
  auto* command = app.add_subcommand("refine", "Points of a level or its limit, and faces between them, in one file");
  auto options = std::make_shared<RefineOptions>();
  add_mesh(*command, options->common);
  add_levels(*command, options->levels);
  command
      ->add_option("--parts", options->levels.division.parts,
                   "How many are made, one after the other by each rank (default: what memory has room for)")
      ->check(CLI::Range(1, 1 << 20));
  command->add_option("-o,--output", options->output, "OUT.ply, binary, with faces; OUT.npy: points alone, any number")
      ->required();
  command->footer(
      "Examples:\n"
      "  mpirun -n 2 sublimit-mpi refine torus.ply -s catmull-clark -l 2 -o refined.ply\n"
      "  mpirun -n 8 sublimit-mpi refine city.ply -s loop -l 4 --limit -o limit.npy\n"
      "Points stand as `apply` of shards has them; faces in the order of the control faces, without those of holes.");
  command->callback([&chosen, options] {
    chosen = [options](const Ranks& ranks) {
      refine(ranks, *options);
      return 0;
    };
  });
}

}  // namespace sublimit::cli_mpi
