// SPDX-License-Identifier: Apache-2.0
#include "commands/bake.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <string_view>

#include "commands/bake_manifest.h"
#include "support/memory_limit.h"
#include "support/facts.h"
#include "sublimit/base/detail/memory.h"
#include "sublimit/base/error.h"

namespace sublimit::cli {
namespace {

struct BakeOptions {
  BakeJob job;
  std::string precision = "float";
  std::string memory_limit, manifest, shard, log, dictionary;
  /// Those given that say what one table is to be; a manifest has them line by line.
  std::function<std::string()> of_one_table;
};

/// `49 points of 8 control points, 3 blocks, 2 groups, 6 patches`
void say_points(Facts& facts, const BakeOutcome& outcome, const BakeStatistics& s) {
  facts.say("{points} points of {control_points} ", {{"points", s.points}, {"control_points", outcome.control_points}});
  facts.add({{"types", s.types}, {"method", s.method == BakeMethod::rows ? "rows" : "patterns"}});
  facts.say(in_words(s) + "\n");
}

void print_plan(const BakeJob& job, const BakeOutcome& outcome) {
  const BakeStatistics& s = outcome.plan->statistics;
  const double bytes = double(s.bytes + s.channel_bytes) - (job.is_float ? 4.0 * double(s.weights) : 0);
  Facts facts("bake");
  say_points(facts, outcome, s);
  facts.say(s.method == BakeMethod::rows || s.channel_bytes > 0 ? "about " : "");
  facts.say("{table_bytes} of table in {precision}, about {memory_bytes} of memory to bake it\n",
            {bytes_fact("table_bytes", bytes),
             {"precision", job.is_float ? "float" : "double"},
             bytes_fact("memory_bytes", outcome.plan->memory)});
  facts.print(job.common);
}

int run_manifest(const BakeOptions& options, const BakeJob& defaults) {
  if (const std::string name = options.of_one_table(); !name.empty())
    throw InvalidOption(name + " is for one table; with --manifest the lines of " + options.manifest + " say it");
  limit_threads(options.job.common);
  return bake_manifest(options.manifest, options.shard.empty() ? Shard{} : parse_shard(options.shard), options.log,
                       options.dictionary, defaults);
}

int run(const BakeOptions& options) {
  BakeJob job = options.job;
  job.memory_limit = parse_memory_limit(options.memory_limit);
  limit_memory(options.memory_limit);
  if (!options.manifest.empty()) return run_manifest(options, job);
  for (const auto& [name, given] : {std::pair("--shard", &options.shard), std::pair("--log", &options.log)})
    if (!given->empty()) throw InvalidOption(std::string(name) + " is for --manifest JOBS.jsonl");
  job.is_float = options.precision == "float";
  for (const auto& [name, given] :
       {std::pair("MESH", &job.common.mesh), std::pair("-o TABLE.safetensors", &job.output)})
    if (given->empty() && !(job.is_plan && given == &job.output))
      throw InvalidOption(std::string(name) + " is missing: bake MESH -s SCHEME -l LEVELS -o TABLE");
  check(job);
  Progress progress(job.common.quiet);
  Dictionaries dictionaries(options.dictionary);
  const auto start = std::chrono::steady_clock::now();
  const BakeOutcome outcome = bake_table(job, dictionaries, progress);
  const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start;
  if (!job.is_plan) dictionaries.save();
  progress.step("");
  if (job.is_plan) print_plan(job, outcome);
  if (job.is_plan) return 0;
  const BakeStatistics& s = outcome.statistics;
  Facts facts("bake");
  facts.say("{output}: ", {{"output", job.output}});
  say_points(facts, outcome, s);
  facts.say("{memory_bytes} in memory in {precision}",
            {bytes_fact("memory_bytes", double(s.bytes + s.channel_bytes)), {"precision", options.precision}});
  if (outcome.file_bytes > 0)
    facts.say(", a file of {file_bytes}", {bytes_fact("file_bytes", double(outcome.file_bytes))});
  facts.say("; {seconds}\n", {seconds_fact("seconds", time.count())});
  facts.print(job.common);
  return 0;
}

}  // namespace

Command add_bake(CLI::App& app) {
  auto* command = app.add_subcommand("bake", "Make a table of stencils, to be applied every frame");
  auto options = std::make_shared<BakeOptions>();
  BakeJob& job = options->job;
  add_mesh(*command, job.common, false);
  command->get_option("MESH")->required(false);  // of a manifest there are many
  command->get_option("--face-varying")
      ->description(
          "Texture coordinates too, of -l LEVELS, with `apply` to write them: where they are linear, by OpenSubdiv's "
          "names (default: none are baked)");
  command->add_option("-l,--levels", job.levels, "The vertices of level LEVELS");
  command->add_flag("--limit", job.limit, "These moved to the limit");
  command->add_option("--grid", job.grid,
                      "N x N places a face on the limit, ends included, u fastest; triangles N (N + 1) / 2");
  command->add_option("--at", job.at,
                      "Places on the limit from a CSV with the header face,u,v, as those of `sample`; of free-form "
                      "surfaces patch,u,v[,side] too");
  command->add_option(
      "--tessellation", job.tessellation,
      "IN.ply that `tessellate` wrote: the places of its vertices, with its triangles, which `apply` writes");
  command
      ->add_option("--derivatives", job.derivatives,
                   "Of the limit, along u and v: 1 first ones, from which `apply` makes normals, 2 second ones too "
                   "(default 0)")
      ->check(CLI::Range(0, 2));
  command->add_flag("--tags", job.tags,
                    "Creases and corners too that -l LEVELS has left, so that refining what `apply` writes goes on");
  command
      ->add_option("--precision", options->precision,
                   "Weights as float, which pipelines apply (default), or double; made in double in either case")
      ->check(CLI::IsMember({"float", "double"}));
  command->add_option("-o,--output", job.output, "OUT.safetensors");
  command->add_flag("--plan", job.is_plan, "Only tell what would be made, and what it would take");
  add_json(*command, job.common);
  add_memory_limit(*command, options->memory_limit);
  command->add_option("--manifest", options->manifest, "JOBS.jsonl: many tables, a JSON object a line");
  command->add_option("--shard", options->shard, "i/n: only every n-th job of the manifest, from the i-th on");
  command->add_option("--log", options->log,
                      "LOG.jsonl gets a JSON object for each job: status, seconds, peak memory in bytes");
  command->add_option(
      "--dictionary", options->dictionary,
      "FILE that keeps types of neighbourhoods from run to run, made if it is not there; a directory has "
      "one for each scheme and its options");
  options->of_one_table = [command] {
    for (const CLI::Option* option : command->get_options())
      if (option->count() > 0 && std::ranges::none_of(std::array{"--manifest", "--shard", "--log", "--threads",
                                                                 "--quiet", "--mem-limit", "--dictionary"},
                                                      [&](const char* name) { return option->check_name(name); }))
        return option->get_name();
    return std::string();
  };
  command->footer(
      "Examples:\n"
      "  sublimit bake cage.obj -s catmull-clark -l 3 -o level3.safetensors\n"
      "  sublimit bake cage.obj -s loop -l 2 --limit --derivatives 1 -o limit.safetensors\n"
      "  sublimit bake cage.obj -s catmull-clark --grid 9 --precision double -o grid.safetensors\n"
      "  sublimit bake cage.obj -s catmull-clark -l 2 --face-varying all --tags -o mesh.safetensors\n"
      "  sublimit bake cage.obj -s catmull-clark --tessellation surface.ply -o surface.safetensors\n"
      "  sublimit bake cage.obj -s catmull-clark -l 5 --plan\n"
      "  sublimit bake teapot.obj --grid 9 --derivatives 1 -o teapot.safetensors      free-form surfaces: no scheme\n"
      "  sublimit apply level3.safetensors frames.npy -o level3.npy\n"
      "  sublimit bake --manifest jobs.jsonl --shard 3/8 --log log.jsonl\n"
      "  sublimit bake cage.obj -s catmull-clark -l 3 --dictionary types.safetensors -o level3.safetensors\n"
      "\nA job of a manifest is an object with the keys mesh, scheme, output, one of levels (with limit: true), grid,\n"
      "at and tessellation, and, if wanted, derivatives, precision, options: {name: value}, boundary, creasing,\n"
      "triangles, triangulate, no-creases, face-varying, tags, strict, as above; paths are relative to the manifest.\n"
      "\nA job is skipped if a sound table of the same job is there; one that fails does not stop the others. The exit\n"
      "status is the highest of any job.\n"
      "\nThe same bytes for any number of threads. The table knows its cage by the connectivity that was refined (with\n"
      "--triangulate that of the triangles); positions are no part of it. --face-varying and --tags refine the mesh\n"
      "itself, once, and make the table about as large as the mesh; faces of holes are left out of it.");
  return [=] { return run(*options); };
}

}  // namespace sublimit::cli
