// SPDX-License-Identifier: Apache-2.0
// sample: the limit anywhere.
#include <fmt/core.h>

#include <cstdint>
#include <limits>

#include "commands.h"
#include "sublimit/base/error.h"
#include "sublimit/distributed/jobs/sample_job.h"
#include "sublimit/stencils/formats/formats.h"

namespace sublimit::cli_mpi {
namespace {

struct SampleOptions {
  Common common;
  SampleRequest request;
  std::optional<std::uint64_t> seed;
};

void check(const SampleRequest& request, bool has_seed) {
  const int places = !request.at.empty() + request.grid.has_value() + request.num_random.has_value();
  if (places != 1)
    throw InvalidOption(fmt::format("{} --at IN.csv, --grid N and --random N; one of them says where to sample",
                                    places == 0 ? "none of" : "more than one of"));
  if (has_seed && !request.num_random) throw InvalidOption("--seed is for --random N");
  if (request.clamp && request.at.empty())
    throw InvalidOption("--clamp is for --at IN.csv; no other places are outside the domain");
  if (request.columns.curvature && request.columns.derivatives < 2)
    throw InvalidOption("--curvature needs --derivatives 2");
  if (!all_formats().writes(request.output, contents::rows))
    throw InvalidOption(request.output.string() + ": samples are written as " +
                        all_formats().writers_in_words({contents::rows}, "or"));
}

void sample(const Ranks& ranks, const SampleOptions& options) {
  const auto start = std::chrono::steady_clock::now();
  const Told told = begin(ranks, options.common);
  SampleRequest request = options.request;
  request.seed = options.seed.value_or(0);
  std::unique_ptr<SampleReader> reader;  // a wrong header is told before a large mesh is read
  ranks.together([&] {
    check(request, options.seed.has_value());
    if (!request.at.empty() && ranks.is_first()) reader = std::make_unique<SampleReader>(request.at, request.clamp);
  });
  const SpreadJob job = load(ranks, options.common, told);
  const SamplesMade made = write_samples(ranks, job, request, reader.get(), told);
  if (!ranks.is_first() || options.common.quiet) return;
  fmt::print("{}: {} samples{}{}; {:.3f} s\n", request.output.string(), made.summary.num_samples,
             made.summary.num_samples > 0 ? " (" + made.summary.text() + ")" : "",
             made.num_clamped > 0 ? fmt::format(", {} moved to the rim of their face", made.num_clamped) : "",
             seconds_since(start));
}

}  // namespace

void add_sample(CLI::App& app, Command& chosen) {
  auto* command = app.add_subcommand("sample", "The exact limit anywhere: points, derivatives, normals, curvature");
  auto options = std::make_shared<SampleOptions>();
  SampleRequest& request = options->request;
  add_mesh(*command, options->common);
  command->add_option("--at", request.at, "Places from a CSV with the header face,u,v");
  command->add_option("--grid", request.grid, "N x N places a face, ends included, u fastest; triangles N (N + 1) / 2")
      ->check(CLI::Range(2, 1 << 15));
  command->add_option("--random", request.num_random, "N places, uniform over faces and parameters")
      ->check(CLI::Range(std::int64_t{0}, std::numeric_limits<std::int64_t>::max()));
  command->add_option("--seed", options->seed, "Of --random: the same places for a seed everywhere (default 0)");
  command
      ->add_option("--derivatives", request.columns.derivatives,
                   "0, 1: with columns xu,..., 2: with xuu,... too (default 0)")
      ->check(CLI::Range(0, 2));
  command->add_flag("--curvature", request.columns.curvature,
                    "Columns k1,k2,gauss,mean: principal curvatures k1 >= k2, Gauss and mean; needs --derivatives 2");
  command->add_flag("--clamp", request.clamp,
                    "Places of --at outside their face are moved to its rim (default: an error that names the row)");
  command->add_option("-o,--output", request.output, "OUT.csv: face,u,v,status,x,y,z[,derivatives],nx,ny,nz")
      ->required();
  command->footer(
      "Examples:\n"
      "  mpirun -n 2 sublimit-mpi sample city.ply -s catmull-clark --at places.csv --derivatives 1 -o points.csv\n"
      "  mpirun -n 8 sublimit-mpi sample city.ply -s loop --random 1000000 --seed 7 -o points.csv\n"
      "Faces, places, columns and bytes are those of `sublimit sample`, in the order asked.");
  command->callback([&chosen, options] {
    chosen = [options](const Ranks& ranks) {
      sample(ranks, *options);
      return 0;
    };
  });
}

}  // namespace sublimit::cli_mpi
