// SPDX-License-Identifier: Apache-2.0
// fit: control points whose limit is near given points.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "commands.h"
#include "sublimit/base/error.h"
#include "sublimit/distributed/jobs/spread_fit.h"
#include "sublimit/distributed/mesh/points_file.h"

namespace sublimit::cli_mpi {
namespace {

struct FitOptions {
  Common common;
  SpreadFitRequest request;
  std::string targets, output;
};

void check(const FitOptions& options) {
  const SpreadFitRequest& request = options.request;
  for (const auto& [name, weight] :
       {std::pair{"--thin-plate", request.fairness.thin_plate}, {"--membrane", request.fairness.membrane}})
    if (!(weight >= 0 && std::isfinite(weight)))
      throw InvalidOption(fmt::format("{} {}: it should be a number, 0 or more", name, weight));
  if (!(request.tolerance > 0 && request.tolerance < 1))
    throw InvalidOption(fmt::format("--tolerance {}: it should be between 0 and 1", request.tolerance));
  check_points_output(options.output);
}

void fit(const Ranks& ranks, const FitOptions& options) {
  const auto start = std::chrono::steady_clock::now();
  const Told told = begin(ranks, options.common);
  ranks.together([&] { check(options); });
  SpreadTargets targets(ranks, options.targets);  // a wrong header is told before a large mesh is read
  const SpreadJob job = load(ranks, options.common, told);
  const SpreadFit found = sublimit::fit(ranks, job, targets, options.request, told);
  if (ranks.is_first())
    for (const std::string& option : found.unused)
      fmt::print(stderr, "sublimit-mpi: warning: --petsc: {} has no effect; it is no option of this solver\n", option);
  told("writing " + options.output);
  write_control_points(ranks, job.mesh, found.points, options.output);
  if (!ranks.is_first() || options.common.quiet) return;
  fmt::print("{}: {} control points, {} faces; the limit {} {} points\n", options.output, job.mesh.vertices.size(),
             job.mesh.faces.size(), targets.at_vertices() && found.converged ? "meets" : "is near", found.num_targets);
  fmt::print("  position error {:.2g} of the box at most, {:.2g} rms\n", found.largest / found.box,
             found.rms / found.box);
  fmt::print("  solved by {}, {} iterations{}; {:.3f} s\n", found.method, std::ranges::max(found.iterations),
             found.converged ? "" : fmt::format(", not converged: {}, gradient {:.2g}", found.reason, found.gradient),
             seconds_since(start));
}

}  // namespace

void add_fit(CLI::App& app, Command& chosen) {
  auto* command = app.add_subcommand("fit", "Control points whose limit is near given points");
  auto options = std::make_shared<FitOptions>();
  SpreadFitRequest& request = options->request;
  add_mesh(*command, options->common);
  command->add_option("--targets", options->targets, "IN.csv: what the limit shall be near, see below")->required();
  command->add_option("-o,--output", options->output, "OUT.npy, or OUT.ply with the faces of MESH")->required();
  command->add_option("--thin-plate", request.fairness.thin_plate,
                      "Weight of the integral of squared second derivatives: fairer between targets");
  command->add_option("--membrane", request.fairness.membrane,
                      "Weight of the integral of squared first derivatives: shorter between targets");
  command->add_option("--tolerance", request.tolerance, "Of the gradient, relative to the data (default 1e-14)");
  command->add_option("--max-iterations", request.max_iterations, "Of each coordinate (default 2000)")
      ->check(CLI::Range(1, 1 << 30));
  command->add_flag("--best-effort", request.best_effort,
                    "Write what comes nearest, also where it did not converge or targets are not met");
  command->add_option("--petsc", request.petsc, "Options of PETSc's solvers, in quotes");
  command->footer(
      "Examples:\n"
      "  mpirun -n 2 sublimit-mpi fit torus.ply --targets places.csv -s catmull-clark -o fitted.ply\n"
      "  mpirun -n 8 sublimit-mpi fit city.ply --targets places.csv -s loop --thin-plate 1e-4 --petsc \"-pc_type gamg\" "
      "-o points.npy\n"
      "IN.csv begins with one of these lines:\n"
      "  vertex,x,y,z                     the limit of a vertex of MESH, counted from 0\n"
      "  face,u,v,x,y,z[,weight]          the limit at a place, as in `sample`: least squares\n"
      "Where targets do not determine the control points, those nearest to MESH are taken, or the fairest ones. The result\n"
      "is that of `sublimit fit` to about 1e-12, not bit by bit. --petsc \"-ksp_monitor\" shows the iterations.");
  command->callback([&chosen, options] {
    chosen = [options](const Ranks& ranks) {
      fit(ranks, *options);
      return 0;
    };
  });
}

}  // namespace sublimit::cli_mpi
