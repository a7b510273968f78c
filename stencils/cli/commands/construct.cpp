// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <memory>

#include "support/common.h"
#include "support/recipes.h"
#include "support/facts.h"
#include "sublimit/stencils/formats/formats.h"
#include "sublimit/stencils/recipes/detail/net_file.h"

namespace sublimit::cli {
namespace {

struct ConstructJob {
  Common common;
  std::string output;
};

std::string counted(size_t count, const char* what) {
  return count == 0 ? "" : fmt::format("{} {}{}, ", count, what, count == 1 ? "" : "s");
}

int run(const ConstructJob& job) {
  check_output_path(job.output, all_formats().writers({contents::free_form}));
  Progress progress(job.common.quiet);
  progress.step("reading " + job.common.mesh);
  const std::vector<Recipe> recipes = read_recipes(job.common.mesh);
  progress.step("");
  if (!job.common.quiet) tell_notes(recipes);
  progress.step("making nets");
  const FreeForm nets = net_file(recipes);
  progress.step("writing " + job.output);
  write_free_form(job.output, nets);
  progress.step("");
  Facts facts("construct");
  facts.say("{output}: {surfaces}{curves}{control_points} control points\n",
            {{"output", job.output},
             {"surfaces", nets.surfaces.size(), counted(nets.surfaces.size(), "surface")},
             {"curves", nets.curves.size(), counted(nets.curves.size(), "curve")},
             {"control_points", nets.vertices.rows()}});
  facts.print(job.common);
  return 0;
}

}  // namespace

Command add_construct(CLI::App& app) {
  auto* command =
      app.add_subcommand("construct", "Write the exact nets of classical curves and surfaces as free-form OBJ");
  auto job = std::make_shared<ConstructJob>();
  command->add_option("RECIPE", job->common.mesh, "Recipes: a .json, one object or {\"recipes\": [..]}")->required();
  command->add_option("-o,--output", job->output, "NET.obj: cstype bezier, bspline, rat where rational")->required();
  add_json(*command, job->common);
  command->add_flag("--quiet", job->common.quiet, "No warnings, no summary");
  std::string kinds;
  size_t width = 0;
  for (const std::string& kind : recipe_kinds()) {
    if (!kinds.empty()) kinds += width + kind.size() > 110 ? ",\n" : ", ";
    width = kinds.empty() || kinds.ends_with('\n') ? kind.size() : width + 2 + kind.size();
    kinds += kind;
  }
  command->footer(
      "Examples:\n"
      "  sublimit construct sphere.json -o sphere.obj\n"
      "  sublimit construct arcs.json --quiet -o arcs.obj\n"
      "  sublimit sample sphere.json --grid 9 --derivatives 1 -o points.csv\n"
      "\nA recipe is an object with its kind and that kind's fields; numbers may be fractions, \"1/3\":\n"
      "  {\"kind\": \"cone\", \"curve\": {\"degree\": 1, \"knots\": [0, 0, 1, 1], \"points\": [[1, 0], [0, 1]]}, \"apex\": [0, 0, 2]}\n"
      "\nKinds:\n" +
      kinds +
      "\n\nThe matrix of a bmatrix_curve has a row for each control point, the coefficients of 1, t, t^2 .., as OBJ's bmat has\n"
      "it; \"form\": \"textbook\" is for M of (t^n .. t 1) M P.\n"
      "\nKinds without an exact net (triangles, screw surfaces, Gregory's patches whose twists disagree, polynomials of\n"
      "too high a degree, nielson, piper) are refused with the reason; `sublimit sample` takes them.");
  return [=] { return run(*job); };
}

}  // namespace sublimit::cli
