// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <algorithm>
#include <memory>

#include "common.h"
#include "memory_limit.h"
#include "sublimit/base/format_number.h"
#include "sublimit/files/closest_files.h"

namespace sublimit::cli {
namespace {

struct ClosestOptions {
  Common common;
  std::string points, output;
};

int run(const ClosestOptions& options) {
  check_output_path(options.output, {".csv"});
  Progress progress(options.common.quiet);
  progress.step("reading " + options.points);
  const Points queries = read_query_points(options.points);
  const Loaded loaded = load(options.common, progress);
  check_mesh_memory(options.common.mesh, loaded.mesh);
  ClosestPoints found;
  naming_mesh(options.common, [&] {
    const LimitSurface surface(*loaded.scheme, loaded.mesh, loaded.rules);
    progress.step(fmt::format("searching for {} points", queries.rows()));
    found = closest_points(surface, loaded.mesh.positions, queries);
  });
  progress.step("writing " + options.output);
  write_closest_points(options.output, found);
  progress.step("");
  if (options.common.quiet) return 0;
  fmt::print("{}: {} points", options.output, queries.rows());
  if (queries.rows() > 0)
    fmt::print(", {} to {} from the limit; bounds are at most {} below", format_number(found.distances.minCoeff()),
               format_number(found.distances.maxCoeff()), format_number((found.distances - found.lower).maxCoeff()));
  fmt::print("\n");
  return 0;
}

}  // namespace

Command add_closest(CLI::App& app) {
  auto* command = app.add_subcommand("closest", "The nearest points of the limit");
  auto options = std::make_shared<ClosestOptions>();
  add_mesh(*command, options->common, true);
  command
      ->add_option("--points", options->points,
                   "Points: a .csv with the header x,y,z, an .npy of n x 3, or the vertices of an .obj, .ply or .off")
      ->required();
  command
      ->add_option("-o,--output", options->output,
                   "OUT.csv: face,u,v,x,y,z,nx,ny,nz,distance,lower,status, a row a point")
      ->required();
  command->footer(
      "Examples:\n"
      "  sublimit closest cage.obj -s catmull-clark --points scan.csv -o closest.csv\n"
      "  sublimit closest cage.obj -s loop --points scan.ply -o closest.csv\n"
      "Faces and places are those of `sublimit sample`, in whose file x,y,z stand for the same point. The limit is not nearer\n"
      "than `lower`, as is proved: the distance but for rounding, less where the proof was cut short, as from the centre\n"
      "of a sphere, all of which is equally near, and 0 where nothing is proved, as of schemes without polynomials. Holes\n"
      "are no part of the limit.");
  return [=] { return run(*options); };
}

}  // namespace sublimit::cli
