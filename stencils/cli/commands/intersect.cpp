// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <algorithm>
#include <memory>
#include <numeric>

#include "commands/searched.h"
#include "support/facts.h"
#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/error.h"
#include "sublimit/parts/parted_surface.h"
#include "sublimit/stencils/files/ray_files.h"
#include "sublimit/stencils/formats/formats.h"

namespace sublimit::cli {
namespace {

struct IntersectOptions {
  Common common;
  std::string rays, output, most_parts;  // a number as given
  bool all = false;
};

RayOptions ray_options(const IntersectOptions& options) {
  RayOptions result{.all = options.all};
  if (options.most_parts.empty()) return result;
  const Parsed<int> parsed = parse_number<int>(options.most_parts);
  if (!parsed || parsed.value < 1)
    throw InvalidOption(
        fmt::format("--most-parts {}: it should be a whole number of parts, 1 or more", options.most_parts));
  result.most_parts = parsed.value;
  return result;
}

int run(const IntersectOptions& options) {
  const Source source = load_source(options.common, {"intersect", {SourceKind::mesh, SourceKind::patches}});
  check_output_path(options.output, all_formats().writers({contents::rows, contents::arrays}));
  const RayOptions search = ray_options(options);
  Progress progress(options.common.quiet);
  progress.step("reading " + options.rays);
  const std::vector<Ray> rays = read_rays(options.rays);
  RayHits hits;
  with_searched_surface(source, progress, [&](const PartedSurface& surface) {
    progress.step(fmt::format("tracing {} rays", rays.size()));
    hits = intersect(surface, rays, search);
  });
  progress.step("writing " + options.output);
  write_ray_hits(options.output, hits);
  progress.step("");
  const auto given_up = std::ranges::count(hits.kinds, HitKind::given_up);
  const int status = given_up > 0 ? 1 : 0;
  const auto touching = std::ranges::count(hits.kinds, HitKind::touching);
  Facts facts("intersect");
  facts.say("{output}: {hits} hits of {rays} rays",
            {{"output", options.output}, {"hits", std::ssize(hits.kinds) - given_up}, {"rays", rays.size()}});
  if (touching > 0)
    facts.say("; {touching} of them touch the surface, as near as numbers go (status touching)",
              {{"touching", touching}});
  if (given_up > 0) facts.add({{"given_up", given_up}});  // which the warning says
  facts.say("\n");
  facts.print(options.common);
  if (given_up > 0 && !options.common.quiet)
    fmt::print(stderr,
               "sublimit: warning: {}: {} rays were given up: each has a row with the status given-up where the search "
               "stopped, and may have more hits from there on than are listed\n",
               options.output, given_up);
  return status;
}

}  // namespace

Command add_intersect(CLI::App& app) {
  auto* command = app.add_subcommand("intersect", "Find where rays meet the limit, or patches");
  auto options = std::make_shared<IntersectOptions>();
  add_mesh(*command, options->common, false);
  add_json(*command, options->common);
  command->add_option("--rays", options->rays, "Rays: a .csv with the header ox,oy,oz,dx,dy,dz[,tmin,tmax]")
      ->required();
  command->add_flag("--all", options->all, "All hits of a ray, by rising t (default: the nearest)");
  command->add_option("--most-parts", options->most_parts,
                      fmt::format("Give a ray up that meets N parts within one part of the surface, or 64 N in all "
                                  "(default {})",
                                  RayOptions{}.most_parts));
  command->add_option("-o,--output", options->output, "OUT.csv: ray,t,face,u,v,x,y,z,nx,ny,nz,status, a row a hit")
      ->required();
  command->footer(
      "Examples:\n"
      "  sublimit intersect cage.obj -s catmull-clark --rays rays.csv -o hits.csv\n"
      "  sublimit intersect cage.obj -s loop --rays rays.csv --all -o hits.csv\n"
      "  sublimit intersect teapot.obj --rays rays.csv -o hits.csv\n"
      "\nA hit is at o + t d. Rays are counted from 0, and go from t = 0 on without end unless tmin and tmax say otherwise.\n"
      "No hit is missed, and a ray through a side that faces share hits once. Holes are no part of the limit. Of schemes\n"
      "without polynomials (butterfly, kobbelt, the sqrt3) every hit is one, but that there are no others is estimated.\n"
      "\nStatus is touching where the ray touches the surface. A ray that meets too much of it is given up: it has a row\n"
      "with the status given-up, where the search stopped, and the exit code is 1.\n"
      "\nWithout -s the rays meet the free-form surfaces of an .obj, or recipes (.json), rational ones too; those that are no\n"
      "B-spline and no polynomial (screw, gregory with twists that differ), or have a pole, are refused.");
  return [=] { return run(*options); };
}

}  // namespace sublimit::cli
