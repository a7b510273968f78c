// SPDX-License-Identifier: Apache-2.0
// `sublimit fit`: control points whose limit goes through given data.
#include <fmt/core.h>

#include <algorithm>

#include "common.h"
#include "curves.h"
#include "sublimit/base/atomic_file.h"
#include "sublimit/base/error.h"
#include "sublimit/base/format_number.h"
#include "sublimit/fit_picture.h"
#include "sublimit/fit_report.h"
#include "sublimit/fit_targets.h"
#include "sublimit/refined_mesh.h"
#include "sublimit/sparse_product.h"

namespace sublimit::cli {
namespace {

struct Options {
  Common common;
  std::string targets, output, report, picture;
  std::string refine = "auto", method = "auto";
  double thin_plate = 0, membrane = 0;
  bool best_effort = false, no_rank = false;
};

void write_text(const std::string& path, const std::string& text) {
  AtomicFile file(path);
  file.write(text);
  file.commit();
}

FitSolverOptions solver_options(const Options& options, Progress& progress) {
  FitSolverOptions solver;
  solver.method = options.method == "direct"      ? FitMethod::direct
                  : options.method == "iterative" ? FitMethod::iterative
                                                  : FitMethod::automatic;
  solver.progress = [&progress](int iteration, double residual) {
    progress.note(fmt::format("solving: iteration {}, residual {:.1e}", iteration, residual));
  };
  return solver;
}

/// What both kinds of report begin with.
FitReport report_of(const Options& options, const Loaded& loaded, const FitTargets& targets, const std::string& kind) {
  FitReport report;
  report.kind = kind;
  report.mesh = options.common.mesh;
  report.targets = options.targets;
  report.scheme = options.common.scheme;
  report.output = options.output;
  for (const auto& [name, value] : loaded.options) report.options.emplace_back(name, value);
  report.options.emplace_back("refine", options.refine);
  report.options.emplace_back("method", options.method);
  for (const auto& [name, weight] : {std::pair{"thin-plate", options.thin_plate}, {"membrane", options.membrane}})
    if (weight > 0) report.options.emplace_back(name, format_number(weight));
  report.mesh_vertices = loaded.mesh.num_vertices();
  report.mesh_faces = loaded.mesh.num_faces();
  report.expected = targets.positions();
  report.box = (report.expected.colwise().maxCoeff() - report.expected.colwise().minCoeff()).norm();
  for (const VertexTarget& target : targets.vertices) report.vertices.push_back(target.vertex);
  report.places = targets.places.places;
  report.weights = targets.places.weights;
  return report;
}

/// A level and its points, with the tags and texture coordinates that it has.
MeshOutput mesh_output(const Options& options, const Loaded& loaded, const Level& level, const Points& points,
                       Progress& progress) {
  MeshOutput out = refined_mesh(level, points, loaded.mesh, loaded.rules, true);
  if (loaded.mesh.face_varying.empty()) return out;
  const std::vector<Level> levels = refined_levels(loaded, level.number, progress);
  const std::vector<FaceVaryingLevel> channel = refined_channel(options.common, loaded, levels, options.output);
  if (channel.empty()) return out;
  add_channel(out, channel.back(), loaded.mesh.face_varying[0].name,
              refined_values(channel, loaded.mesh.face_varying[0].values));
  out.face_varying_interpolation = loaded.face_varying;
  return out;
}

Points normals_of(const FitTargets& targets) {
  if (targets.num_normals == 0) return {};
  Points normals = Points::Zero(static_cast<Index>(targets.size()), 3);
  for (size_t i = 0; i < targets.vertices.size(); ++i)
    if (const auto& n = targets.vertices[i].normal)
      normals.row(static_cast<Index>(i)) = (*n / n->cwiseAbs().maxCoeff()).normalized();
  return normals;
}

void write_outputs(const Options& options, const Loaded& loaded, const FitTargets& targets, const Level& level,
                   const Points& points, FitReport& report, Progress& progress) {
  const MeshOutput out = mesh_output(options, loaded, level, points, progress);
  report.output_vertices = static_cast<Index>(out.positions.rows());
  report.output_faces = static_cast<Index>(out.face_sizes.size());
  report.refinements = level.number;
  report.keeps_vertices = level.number == 0 || !loaded.scheme->is_dual();
  std::string picture;
  if (!options.picture.empty()) {
    progress.step("drawing " + options.picture);
    const std::string what =
        fmt::format("{} points{}", targets.size(),
                    targets.num_normals > 0 ? fmt::format(", {} normals", targets.num_normals) : std::string());
    picture = fit_picture(*loaded.scheme, control_level(*loaded.scheme, loaded.mesh, loaded.rules),
                          loaded.mesh.positions, level, points,
                          {.targets = targets.positions(),
                           .normals = normals_of(targets),
                           .before = "given",
                           .before_note = what,
                           .between = "limit of the given mesh",
                           .between_note = loaded.scheme->name,
                           .after = "limit of the fit",
                           .after_note = fmt::format("{} control points", report.output_vertices)});
  }
  progress.step("writing " + options.output);
  if (!options.report.empty()) write_text(options.report, fit_report(report));
  if (!options.picture.empty()) write_text(options.picture, picture);
  write_mesh(options.output, out);
  progress.step("");
  if (!options.common.quiet) fmt::print("{}", fit_summary(report));
}

int interpolate_vertices(const Options& options, const Loaded& loaded, const FitTargets& targets, Progress& progress) {
  if (targets.num_curvatures > 0)
    throw FormatError(options.targets + ": " + options.common.scheme +
                      " is linear and takes points and normals; leave the columns k1,k2,d1x,d1y,d1z out, or fit with "
                      "-s torus-pieces");
  InterpolationOptions wanted{.fairness = {.thin_plate = options.thin_plate, .membrane = options.membrane},
                              .solver = solver_options(options, progress),
                              .rules = loaded.rules,
                              .conditioning = !options.no_rank};
  if (options.refine != "auto") wanted.least_refinements = wanted.most_refinements = options.refine[0] - '0';
  Interpolation found;
  naming_mesh(options.common, [&] {
    check_vertices(targets, control_level(*loaded.scheme, loaded.mesh, loaded.rules).topology());
    progress.step("solving");
    found = interpolate(*loaded.scheme, loaded.mesh, targets.vertices, wanted);
    if (!found.solved() && !options.best_effort)
      throw InvalidMesh(why_unsolved(found.attempts.back()) + "; --best-effort writes what comes nearest");
  });
  FitReport report = report_of(options, loaded, targets, "interpolation");
  report.position_error = found.position_error;
  if (targets.num_normals > 0) report.normal_error = found.normal_error;
  report.attempts = found.attempts;
  report.solution = found.solution;
  for (const Index i : found.without_plane) report.without_plane.push_back(targets.vertices[i].vertex);
  if (!report.without_plane.empty())
    report.notes.push_back(
        fmt::format("{} normals are left out: the scheme has no tangent plane there", report.without_plane.size()));
  if (!found.solved()) report.notes.push_back("not met: " + why_unsolved(found.attempts.back()));
  write_outputs(options, loaded, targets, found.level, found.points, report, progress);
  return 0;
}

int run(const Options& options) {
  if (is_curve_job(options.common))
    throw InvalidOption(options.common.scheme + " refines curves; fits are of surfaces (`sublimit schemes` lists all)");
  check_output_path(options.output, {".obj", ".ply"});
  if (!options.report.empty()) check_output_path(options.report, {".json"});
  if (!options.picture.empty()) check_output_path(options.picture, {".svg"});
  Progress progress(options.common.quiet);
  progress.step("reading " + options.targets);
  const FitTargets targets = read_fit_targets(options.targets);  // a wrong header is told before a large mesh is read
  const Loaded loaded = load(options.common, progress);
  return interpolate_vertices(options, loaded, targets, progress);
}

}  // namespace

Command add_fit(CLI::App& app) {
  auto* command = app.add_subcommand("fit", "Control points whose limit goes through given points and normals");
  auto options = std::make_shared<Options>();
  add_mesh(*command, options->common, true);
  command->add_option("--targets", options->targets, "IN.csv: what the limit shall go through, see below")->required();
  command
      ->add_option("-o,--output", options->output, "OUT.obj (with tags, so that `limit` gives the targets) or OUT.ply")
      ->required();
  command->add_option("--report", options->report, "Everything that was found, as data, .json");
  command->add_option("--picture", options->picture, "Before and after, .svg");
  command
      ->add_option("--refine", options->refine,
                   "Refinements that may add control points: auto (as few as needed, 2 at most), or exactly so many")
      ->check(CLI::IsMember({"auto", "0", "1", "2", "3"}));
  command->add_option("--thin-plate", options->thin_plate, "Weight of the integral of squared second derivatives")
      ->check(CLI::NonNegativeNumber);
  command->add_option("--membrane", options->membrane, "Weight of the integral of squared first derivatives")
      ->check(CLI::NonNegativeNumber);
  command->add_option("--method", options->method, "auto, direct (factorisation) or iterative (conjugate gradients)")
      ->check(CLI::IsMember({"auto", "direct", "iterative"}));
  command->add_flag(
      "--best-effort", options->best_effort,
      "Where targets cannot all be met, write what comes nearest (default: an error, nothing is written)");
  command->add_flag("--no-rank", options->no_rank, "Leave rank and condition out, which takes time on large meshes");
  command->footer(
      "Examples:\n"
      "  sublimit fit cage.obj --targets points.csv -s catmull-clark -o fitted.obj\n"
      "  sublimit fit cage.obj --targets normals.csv -s loop --thin-plate 1 -o fitted.obj --report fit.json\n"
      "  sublimit limit fitted.obj -s loop --normals -o surface.obj    (its first vertices are the targets)\n"
      "IN.csv begins with one of these lines:\n"
      "  vertex,x,y,z[,nx,ny,nz[,k1,k2,d1x,d1y,d1z]]   the limit of a vertex of MESH, counted from 0; a normal of any\n"
      "                                                length, or three empty fields\n"
      "  face,u,v,x,y,z[,weight]                       the limit at a place, as in `sublimit sample`: least squares\n"
      "Points alone are as many conditions as there are control points, which may depend on each other (a cube's do);\n"
      "normals are more. Then MESH is refined, and of all control points that meet the targets those nearest to it "
      "are\n"
      "taken, or the fairest ones (--thin-plate, --membrane). Under schemes that keep vertices the first ones of OUT "
      "are\n"
      "those of MESH, in order.");
  return [=] { return run(*options); };
}

}  // namespace sublimit::cli
