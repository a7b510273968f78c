// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <algorithm>
#include <memory>

#include "commands/searched.h"
#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/detail/memory.h"
#include "sublimit/base/error.h"
#include "sublimit/parts/parted_surface.h"
#include "sublimit/stencils/files/closest_files.h"
#include "sublimit/stencils/formats/formats.h"
#include "support/memory_limit.h"
#include "support/facts.h"

namespace sublimit::cli {
namespace {

struct ClosestOptions {
  Common common;
  std::string points, output, nearest, radius;  // numbers as given
  bool is_signed = false;
};

ClosestPointOptions search_options(const ClosestOptions& options) {
  ClosestPointOptions search{.is_signed = options.is_signed};
  if (!options.nearest.empty()) {
    const Parsed<int> parsed = parse_number<int>(options.nearest);
    if (!parsed || parsed.value < 1)
      throw InvalidOption(
          fmt::format("--nearest {}: it should be a whole number of faces, 1 or more", options.nearest));
    search.nearest = parsed.value;
  }
  if (!options.radius.empty()) {
    const Parsed<double> parsed = parse_number<double>(options.radius);
    if (!parsed || !(parsed.value >= 0))
      throw InvalidOption(fmt::format("--radius {}: it should be a distance, 0 or more", options.radius));
    search.radius = parsed.value;
  }
  return search;
}

ClosestPoints search_of(const PartedSurface& surface, const Points& queries, const ClosestPointOptions& search,
                        Progress& progress) {
  const double rows = double(queries.rows()) * std::min<double>(search.nearest, surface.faces().size);
  constexpr double bytes_a_row = 300;  // of what is found, and of what it is collected in
  check_memory(fmt::format("{:.0f} nearest faces of {} points", rows, queries.rows()), rows * bytes_a_row,
               "give a smaller --nearest, or divide the file");
  progress.step(fmt::format("searching for {} points", queries.rows()));
  return closest(surface, queries, search);
}

int run(const ClosestOptions& options) {
  const Source source = load_source(options.common, {"closest", {SourceKind::mesh, SourceKind::patches}});
  check_output_path(options.output, all_formats().writers({contents::rows, contents::arrays}));
  const ClosestPointOptions search = search_options(options);
  Progress progress(options.common.quiet);
  progress.step("reading " + options.points);
  const Points queries = read_query_points(options.points);
  ClosestPoints found;
  with_searched_surface(source, progress,
                        [&](const PartedSurface& surface) { found = search_of(surface, queries, search, progress); });
  progress.step("writing " + options.output);
  write_closest_points(options.output, found, !options.nearest.empty() || !options.radius.empty());
  progress.step("");
  Facts facts("closest");
  facts.say("{output}: {points} points", {{"output", options.output}, {"points", queries.rows()}});
  if (!options.nearest.empty() || !options.radius.empty()) {
    std::int64_t without = 0;
    for (size_t i = 0; i + 1 < found.first.size(); ++i) without += found.first[i] == found.first[i + 1];
    facts.say(", {rows} rows", {{"rows", found.places.size()}});
    if (without > 0)
      facts.say("; {points_without} points have no face within {radius}",
                {{"points_without", without}, {"radius", options.radius}});
  }
  if (!found.places.empty())
    facts.say(", {least_distance} to {largest_distance} from the limit; bounds are at most {bound_below} below",
              {{"least_distance", found.distances.minCoeff()},
               {"largest_distance", found.distances.maxCoeff()},
               {"bound_below", (found.distances.cwiseAbs() - found.lower).maxCoeff()}});
  facts.say("\n");
  facts.print(options.common);
  return 0;
}

}  // namespace

Command add_closest(CLI::App& app) {
  auto* command = app.add_subcommand("closest", "Find the nearest points of the limit, or of patches");
  auto options = std::make_shared<ClosestOptions>();
  add_mesh(*command, options->common, false);
  add_json(*command, options->common);
  command
      ->add_option("--points", options->points,
                   "Points: a .csv with the header x,y,z, an .npy of n x 3, or the vertices of a mesh")
      ->required();
  command->add_option("--nearest", options->nearest, "K faces a point, each with its nearest place (default 1)");
  command->add_option("--radius", options->radius, "Leave out what is farther than that (default: nothing)");
  command->add_flag("--signed", options->is_signed, "Distances below 0 of points inside, of a closed surface");
  command
      ->add_option("-o,--output", options->output,
                   "OUT.csv: face,u,v,x,y,z,nx,ny,nz,distance,lower,status, a row a point; with --nearest or --radius "
                   "a row a face found, and `point` first, from 0")
      ->required();
  command->footer(
      "Examples:\n"
      "  sublimit closest cage.obj -s catmull-clark --points scan.csv -o closest.csv\n"
      "  sublimit closest cage.obj -s loop --points scan.ply -o closest.csv\n"
      "  sublimit closest cage.obj -s catmull-clark --points scan.csv --signed -o signed.csv\n"
      "  sublimit closest cage.obj -s catmull-clark --points scan.csv --nearest 3 --radius 0.1 -o near.csv\n"
      "  sublimit closest teapot.obj --points scan.csv -o closest.csv\n"
      "\nFaces and places are those of `sublimit sample`, in whose file x,y,z stand for the same point. The limit is not\n"
      "nearer than `lower`, as is proved: the distance but for rounding, less where the proof was cut short, as from the\n"
      "centre of a sphere, all of which is equally near, and 0 where nothing is proved, as of schemes without polynomials.\n"
      "Of the second row of a point on, `lower` is of all faces but those in the rows before. Holes are no part of the\n"
      "limit. Inside is what the surface winds around, however its normals look; `lower` has no sign.\n"
      "\nWithout -s the free-form surfaces of an .obj, or recipes (.json), are searched, rational ones too. Nothing is proved\n"
      "where one of them is no B-spline and no polynomial (screw, gregory with twists that differ), or has a pole.");
  return [=] { return run(*options); };
}

}  // namespace sublimit::cli
