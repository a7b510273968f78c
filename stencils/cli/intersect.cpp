// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <algorithm>
#include <memory>
#include <numeric>

#include "free_form.h"
#include "searched.h"
#include "sublimit/files/ray_files.h"

namespace sublimit::cli {
namespace {

struct IntersectOptions {
  Common common;
  std::string rays, output;
  bool all = false;
};

int run(const IntersectOptions& options) {
  const bool free_form = is_free_form_job(options.common);
  check_output_path(options.output, {".csv"});
  Progress progress(options.common.quiet);
  progress.step("reading " + options.rays);
  const std::vector<Ray> rays = read_rays(options.rays);
  RayHits hits;
  with_searched_surface(options.common, free_form, progress, [&](const SearchedSurface& surface) {
    progress.step(fmt::format("tracing {} rays", rays.size()));
    hits = intersect(surface, rays, {.all = options.all});
  });
  progress.step("writing " + options.output);
  write_ray_hits(options.output, hits);
  progress.step("");
  if (options.common.quiet) return 0;
  const auto undecided = std::ranges::count_if(hits.undecided, [](std::int64_t n) { return n > 0; });
  fmt::print("{}: {} hits of {} rays", options.output, hits.t.size(), rays.size());
  if (undecided > 0)
    fmt::print("; {} of them touch the surface, or meet an extraordinary vertex, as near as numbers go", undecided);
  fmt::print("\n");
  return 0;
}

}  // namespace

Command add_intersect(CLI::App& app) {
  auto* command = app.add_subcommand("intersect", "Where rays meet the limit, or patches");
  auto options = std::make_shared<IntersectOptions>();
  add_mesh(*command, options->common, false);
  command->add_option("--rays", options->rays, "Rays: a .csv with the header ox,oy,oz,dx,dy,dz[,tmin,tmax]")
      ->required();
  command->add_flag("--all", options->all, "All hits of a ray, by rising t (default: the nearest)");
  command->add_option("-o,--output", options->output, "OUT.csv: ray,t,face,u,v,x,y,z,nx,ny,nz,status, a row a hit")
      ->required();
  command->footer(
      "Examples:\n"
      "  sublimit intersect cage.obj -s catmull-clark --rays rays.csv -o hits.csv\n"
      "  sublimit intersect cage.obj -s loop --rays rays.csv --all -o hits.csv\n"
      "  sublimit intersect teapot.obj --rays rays.csv -o hits.csv\n"
      "A hit is at o + t d. Rays are counted from 0, and go from t = 0 on without end unless tmin and tmax say otherwise.\n"
      "No hit is missed, and a ray through a side that faces share hits once. Holes are no part of the limit.\n"
      "Without -s the rays meet the free-form surfaces of an .obj, or recipes (.json), rational ones too; those that are no\n"
      "B-spline and no polynomial (screw, gregory with twists that differ), or have a pole, are refused.");
  return [=] { return run(*options); };
}

}  // namespace sublimit::cli
