// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <limits>
#include <numbers>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/error.h"
#include "sublimit/stencils/formats/formats.h"
#include "sublimit/sublimit.h"
#include "support/common.h"
#include "support/facts.h"

namespace sublimit::cli {
namespace {

struct FlattenJob {
  Common common;  // mesh: the scene
  std::string chord = "0.1%", output;
  std::optional<double> angle;
  std::int64_t most = FlattenOptions{}.max_triangles;
};

FlattenOptions flatten_options(const FlattenJob& job) {
  FlattenOptions options{.max_triangles = job.most};
  const double chord = distance_option("--chord", job.chord, 1);
  (job.chord.ends_with('%') ? options.relative_chord : options.chord) = chord;
  if (job.angle) options.angle = *job.angle * std::numbers::pi / 180;
  return options;
}

int run(const FlattenJob& job) {
  limit_threads(job.common);
  const FlattenOptions options = flatten_options(job);
  if (!all_formats().reads(job.common.mesh, contents::scenes))
    throw InvalidOption(fmt::format("{}: a scene is read as {}; `tessellate` takes other meshes", job.common.mesh,
                                    all_formats().readers_in_words({contents::scenes}, "or")));
  check_output_path(job.output, all_formats().writers({contents::scenes, contents::meshes}));
  Progress progress(job.common.quiet);
  progress.step("reading " + job.common.mesh);
  const FlattenedScene made = flatten(job.common.mesh, job.output, options, [&](const std::string& path) {
    progress.step(path.empty() ? "writing " + job.output : "tessellating " + path);
  });
  progress.step("");
  std::int64_t triangles = 0, flat = 0;
  for (const FlattenedScene::FlatMesh& mesh : made.meshes) triangles += mesh.triangles, flat += mesh.why_not.empty();
  const bool all = flat == std::ssize(made.meshes);
  for (const FlattenedScene::FlatMesh& mesh : made.meshes)
    if (!mesh.why_not.empty()) fmt::print(stderr, "sublimit: {}: left as it is: {}\n", mesh.path, mesh.why_not);
  constexpr std::size_t most_warnings = 20;
  if (!job.common.quiet) {
    for (std::size_t i = 0; i < std::min(made.warnings.size(), most_warnings); ++i)
      fmt::print(stderr, "sublimit: warning: {}\n", made.warnings[i]);
    if (made.warnings.size() > most_warnings)
      fmt::print(stderr, "sublimit: warning: and {} more\n", made.warnings.size() - most_warnings);
    if (made.meshes.empty())
      fmt::print(stderr, "sublimit: note: {}: no mesh with a scheme that is seen; nothing to flatten\n",
                 job.common.mesh);
  }
  double bound = 0;
  for (const FlattenedScene::FlatMesh& mesh : made.meshes) bound = std::max(bound, mesh.bound);
  Facts facts("flatten");
  facts.say(
      "{output}: {flat} of {meshes} meshes with a scheme are {triangles} triangles, at most {bound} from their "
      "limits\n",
      {{"output", job.output},
       {"flat", flat},
       {"meshes", made.meshes.size()},
       {"triangles", triangles},
       {"bound", bound}});
  facts.print(job.common);
  return all ? 0 : 1;
}

}  // namespace

Command add_flatten(CLI::App& app) {
  auto* command = app.add_subcommand("flatten", "Make triangles of the subdivision meshes of a USD scene");
  auto job = std::make_shared<FlattenJob>();
  command->add_option("SCENE", job->common.mesh, "A scene: .usda, .usdz")->required();
  command
      ->add_option("-o,--output", job->output,
                   "OUT.usda or OUT.usdz: the scene, in which all else stays byte for byte; OUT.glb, or another format "
                   "of meshes: all meshes of the scene")
      ->required();
  command->add_option("--chord", job->chord,
                      "Largest distance of triangles from the limit: in the unit of the scene, or as a part of the "
                      "diagonal of each mesh (default 0.1%)");
  command
      ->add_option("--angle", job->angle,
                   "Largest angle between normals in the cell of a triangle, in degrees (default: any)")
      ->check(CLI::Range(std::numeric_limits<double>::min(), 180.0));
  command->add_option("--max-triangles", job->most, "Stop if a mesh needs more (default 16777216)")
      ->check(CLI::Range(1, std::numeric_limits<Index>::max()));
  add_run(*command, job->common);
  add_json(*command, job->common);
  command->footer(
      "Examples:\n"
      "  sublimit flatten scene.usda -o flat.usda\n"
      "  sublimit flatten asset.usdz --chord 0.05% -o flat.usdz\n"
      "  sublimit flatten scene.usda --chord 0.002 --angle 10 -o scene.glb\n"
      "\nEach mesh that is seen and has a scheme gets points on its limit, exact normals and subdivisionScheme \"none\".\n"
      "Vertex, varying, uniform and face-varying primvars and subsets of faces follow. Points with samples in time keep\n"
      "their times; the distance is proved for the first one, the same places of the limit are taken at all others.\n"
      "\nRead are sublayers, references, payloads, inherited prims and selected variants of text layers. A mesh that comes\n"
      "from another layer is overridden in the first one. Meshes bound to a skeleton are left as they are; the exit status\n"
      "is then 1.");
  return [=] { return run(*job); };
}

}  // namespace sublimit::cli
