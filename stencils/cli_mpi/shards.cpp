// SPDX-License-Identifier: Apache-2.0
// bake, apply, verify: tables in shards.
#include <fmt/core.h>

#include "commands.h"
#include "sublimit/base/error.h"

namespace sublimit::cli_mpi {
namespace {

struct BakeOptions {
  Common common;
  Levels levels;
  bool overwrite = false;
  int rings = 0;
  std::string output;
};

void bake(const Ranks& ranks, const BakeOptions& options) {
  const auto start = std::chrono::steady_clock::now();
  const Told told = begin(ranks, options.common);
  const SpreadJob job = load(ranks, options.common, told);
  const Levels levels = options.levels.resolved();
  const ShardsMade made =
      bake_shards(ranks, job, levels.request, levels.division, options.output, options.overwrite, options.rings, told);
  if (!ranks.is_first() || options.common.quiet) return;
  if (options.rings > 0 && made.rings > options.rings)
    fmt::print(stderr, "sublimit-mpi: warning: --rings {} widened to {}, which types of {} need\n", options.rings,
               made.rings, job.scheme.name);
  fmt::print("{}: {} points of {} in {} shards{}; {:.3f} s\n", options.output, made.manifest.all.num_points,
             made.manifest.all.num_control_points, made.manifest.all.count,
             made.kept > 0 ? fmt::format(", {} of them there before", made.kept) : "", seconds_since(start));
}

}  // namespace

void add_bake(CLI::App& app, Command& chosen) {
  auto* command = app.add_subcommand("bake", "A table in shards, each of some faces");
  auto options = std::make_shared<BakeOptions>();
  add_mesh(*command, options->common);
  add_levels(*command, options->levels);
  command->add_option("--shards", options->levels.division.parts, "How many (default: one a rank)")
      ->check(CLI::Range(1, 1 << 20));
  command->add_option("--rings", options->rings, "Faces around each part, if more than its types need")
      ->check(CLI::Range(0, 64));
  command->add_option("-o,--output", options->output, "DIR: shards, and shards.json when all are there")->required();
  command->add_flag("--overwrite", options->overwrite, "Remove shards of another bake that are in DIR");
  command->footer(
      "Examples:\n"
      "  mpirun -n 2 sublimit-mpi bake torus.ply -s catmull-clark -l 2 -o shards\n"
      "  mpirun -n 8 sublimit-mpi bake city.ply -s loop -l 3 --limit --shards 64 -o shards\n"
      "A bake that was ended goes on with the shards that are missing. Each is a table that sublimit reads too: 'shard.inputs'\n"
      "are its control points, 'shard.runs' say where its points stand: in the order of faces, those on a side with the\n"
      "first face that has them, whatever the numbers of ranks and shards.");
  command->callback([&chosen, options] {
    chosen = [options](const Ranks& ranks) {
      bake(ranks, *options);
      return 0;
    };
  });
}

void add_apply(CLI::App& app, Command& chosen) {
  struct Options {
    Common common;
    std::string shards, points, output;
    bool any_cage = false;
  };
  auto* command = app.add_subcommand("apply", "Points of poses, by any number of ranks");
  auto options = std::make_shared<Options>();
  command->add_option("SHARDS", options->shards, "DIR of a bake")->required();
  command
      ->add_option("POINTS", options->points,
                   "Points of the cage: a mesh as `bake` reads it, or an .npy of vertices x channels or frames x "
                   "vertices x channels")
      ->required();
  command->add_option("-o,--output", options->output, "OUT.npy or OUT.ply, in double")->required();
  command->add_flag("--any-cage", options->any_cage, "Take a mesh with other faces than those of the table's cage");
  add_run(*command, options->common);
  command->footer(
      "Examples:\n"
      "  mpirun -n 3 sublimit-mpi apply shards pose.ply -o points.npy\n"
      "  mpirun -n 3 sublimit-mpi apply shards animation.npy -o refined.npy    one frame after the other");
  command->callback([&chosen, options] {
    chosen = [options](const Ranks& ranks) {
      const auto start = std::chrono::steady_clock::now();
      const std::int64_t frames = apply_shards(ranks, options->shards, options->points, options->output,
                                               options->any_cage, begin(ranks, options->common));
      if (ranks.is_first() && !options->common.quiet)
        fmt::print("{}: {} frame{}; {:.3f} s\n", options->output, frames, frames == 1 ? "" : "s", seconds_since(start));
      return 0;
    };
  });
}

void add_verify(CLI::App& app, Command& chosen) {
  struct Options {
    Common common;
    std::string shards;
  };
  auto* command = app.add_subcommand("verify", "Whether shards are whole, and make each point once");
  auto options = std::make_shared<Options>();
  command->add_option("SHARDS", options->shards, "DIR of a bake")->required();
  add_run(*command, options->common);
  command->footer("Example:\n  mpirun -n 2 sublimit-mpi verify shards");
  command->callback([&chosen, options] {
    chosen = [options](const Ranks& ranks) {
      const std::vector<std::string> faults = verify_shards(ranks, options->shards, begin(ranks, options->common));
      const std::string list = ranks.told_by_first([&] {
        std::string text;
        for (const std::string& fault : faults) text += (text.empty() ? "" : "\n  ") + fault;
        return text;
      }());
      ranks.together([&] {
        if (!list.empty()) throw FormatError(list);
      });
      if (ranks.is_first() && !options->common.quiet) fmt::print("{}: whole\n", options->shards);
      return 0;
    };
  });
}

}  // namespace sublimit::cli_mpi
