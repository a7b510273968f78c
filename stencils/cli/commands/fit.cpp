// SPDX-License-Identifier: Apache-2.0
// `sublimit fit`: control points whose limit goes through given data.
#include <fmt/core.h>

#include <cmath>

#include "support/common.h"
#include "support/free_form.h"
#include "support/memory_limit.h"
#include "support/facts.h"
#include "sublimit/base/detail/atomic_file.h"
#include "sublimit/base/error.h"
#include "sublimit/stencils/files/level_files.h"
#include "sublimit/stencils/fit_jobs/fit_picture.h"
#include "sublimit/stencils/formats/formats.h"

namespace sublimit::cli {
namespace {

struct FitOptions {
  Common common;
  std::string targets, cloud, output, report, picture;
  std::string method = "auto", pin, memory_limit;
  FitSettings settings;
  bool no_rank = false;
  std::optional<Index> samples;  ///< of the cloud's mesh
  unsigned seed = 1;
  std::map<std::string, std::string> given;  ///< what stands in the report
  bool has(const char* option) const { return given.contains(option); }
};

/// What options belong to; all others are for every fit.
constexpr std::pair<const char*, const char*> owners[] = {
    {"--refine", "vertices"},
    {"--best-effort", "vertices"},
    {"--construct", "vertices"},
    {"--size", "vertices"},
    {"--pin", "places cloud"},
    {"--thin-plate", "vertices places cloud"},
    {"--membrane", "vertices places cloud"},
    {"--method", "vertices places cloud"},
    {"--no-rank", "vertices places"},
    {"--levels", "torus-pieces"},
    {"--iterations", "cloud"},
    {"--samples", "cloud"},
    {"--seed", "cloud"},
};

/// An option that would be ignored is a mistake of whoever gave it.
void refuse_others(const FitOptions& options, const std::string& job, const char* words) {
  for (const auto& [option, jobs] : owners)
    if (options.has(option) && std::string(jobs).find(job) == std::string::npos)
      throw InvalidOption(fmt::format("{} is not for {}; leave it out", option, words));
  if (options.has("--size") && !options.settings.construct)
    throw InvalidOption("--size is for --construct; leave it out");
  if (!options.settings.construct) return;
  for (const char* option : {"--refine", "--thin-plate", "--membrane", "--method", "--no-rank", "--best-effort"})
    if (options.has(option))
      throw InvalidOption(
          fmt::format("{} is for fits that solve a system, and --construct solves none; leave it out", option));
}

void write_text(const std::string& path, const std::string& text) {
  AtomicFile file(path);
  file.write(text);
  file.commit();
}

/// A level and its points, with the tags, texture coordinates, values and names that it has.
Mesh mesh_output(const FitOptions& options, const Loaded& loaded, const ReportedFit& fit, Progress& progress) {
  Mesh out = level_output(fit.level, fit.points, loaded.mesh, loaded.rules, true);
  if (loaded.mesh.face_varying.empty() && !carries_attributes(loaded.mesh)) return out;
  const std::vector<Level> levels = refined_levels(loaded, fit.level.number, progress);
  carry_attributes(loaded, levels, out);
  const std::vector<FaceVaryingLevel> channel = refined_channel(options.common, loaded, levels, options.output);
  if (channel.empty()) return out;
  add_channel(out, channel.back(), loaded.mesh.face_varying[0].name,
              refined_values(channel, loaded.mesh.face_varying[0].values));
  out.face_varying_interpolation = loaded.face_varying;
  return out;
}

/// The result first: no report of what could not be written.
void write_outputs(const FitOptions& options, const std::function<void()>& write_result, const std::string& picture,
                   FitReport& report, Progress& progress) {
  report.mesh = options.common.mesh;
  report.targets = options.cloud.empty() ? options.targets : options.cloud;
  report.output = options.output;
  report.options = options.given;
  progress.step("writing " + options.output);
  write_result();
  if (!options.picture.empty()) write_text(options.picture, picture);
  if (!options.report.empty()) write_text(options.report, fit_report(report));
  progress.step("");
  if (options.common.json)
    fmt::print("{}", fit_report(report));
  else if (!options.common.quiet)
    fmt::print("{}", fit_summary(report));
}

int fit_linear(const FitOptions& options, Progress& progress,
               const std::function<ReportedFit(const Loaded& loaded, const FitSettings& settings)>& job) {
  const Loaded loaded = load(options.common, progress);
  check_mesh_memory(options.common.mesh, loaded.mesh);
  FitSettings settings = options.settings;
  settings.rules = loaded.rules;
  settings.progress = [&](const std::string& what) { progress.note(what); };
  if (!options.pin.empty()) settings.pins = read_pins(options.pin, loaded.mesh.num_vertices());
  ReportedFit fit;
  std::string picture;
  Mesh mesh;
  naming_mesh(options.common, [&] {
    progress.step("fitting");
    fit = job(loaded, settings);
    mesh = mesh_output(options, loaded, fit, progress);
    if (options.picture.empty()) return;
    progress.step("drawing " + options.picture);
    picture = fit_picture(*loaded.scheme, control_level(*loaded.scheme, loaded.mesh, loaded.rules),
                          loaded.mesh.positions, fit);
  });
  write_outputs(
      options, [&] { write_output(options.common, options.output, mesh, loaded.mesh, progress); }, picture, fit.report,
      progress);
  return 0;
}

Cloud checked_cloud(const FitOptions& options, Progress& progress) {
  refuse_others(options, "cloud", "clouds");
  if (options.has("--seed") && !options.samples) throw InvalidOption("--seed is for --samples N; leave it out");
  if (options.samples && *options.samples < 1)
    throw InvalidOption(fmt::format("--samples {}: it should be a number of points, 1 or more", *options.samples));
  if (options.settings.iterations < 0)
    throw InvalidOption(fmt::format("--iterations {}: it should be 0 or more", options.settings.iterations));
  progress.step("reading " + options.cloud);
  return read_cloud(options.cloud, options.samples, options.seed);
}

int fit_to_cloud(const FitOptions& options, Progress& progress) {
  const Cloud cloud = checked_cloud(options, progress);
  return fit_linear(options, progress, [&](const Loaded& loaded, const FitSettings& settings) {
    return fit_near_cloud(*loaded.scheme, loaded.mesh, cloud, settings);
  });
}

int fit_geometric(const FitOptions& options, const FitTargets& targets, const GeometricSurfaceScheme& scheme,
                  Progress& progress) {
  for (const auto& [option, value] : {std::pair{"--boundary", &options.common.boundary},
                                      {"--creasing", &options.common.creasing},
                                      {"--triangles", &options.common.triangles},
                                      {"--face-varying", &options.common.face_varying}})
    if (!value->empty()) throw InvalidOption(fmt::format("{} is not for {}; leave it out", option, scheme.name));
  Common common = options.common;
  common.scheme.clear();  // it has no masks to load
  common.options.clear();
  const Loaded loaded = load(common, progress);
  FitSettings settings = options.settings;
  settings.progress = [&](const std::string& what) { progress.note(what); };
  CurvatureFit fit;
  std::string picture;
  naming_mesh(options.common, [&] {
    progress.step("refining");
    fit = fit_curvatures(scheme, loaded.mesh, targets, settings);
  });
  progress.step("drawing");
  if (!options.picture.empty()) picture = fit_picture(fit);
  write_outputs(
      options, [&] { write_mesh(options.output, output(fit.refined), progress.bytes_written()); }, picture, fit.report,
      progress);
  return 0;
}

/// Patches, to targets at places or to a cloud.
int fit_patch_points(const FitOptions& options, const Source& source, Progress& progress) {
  if (!options.picture.empty()) throw InvalidOption("--picture is for meshes; leave it out");
  check_output_path(options.output, all_formats().writers({contents::free_form}));
  FitColumns fit_columns;
  if (!options.cloud.empty()) {
    fit_columns = [cloud = checked_cloud(options, progress)](const PatchSet& patches, const Points& columns,
                                                             const FitSettings& settings) {
      return fit_patches_near_cloud(patches, columns, cloud, settings);
    };
  } else {
    refuse_others(options, "places", "free-form surfaces");
    fit_columns = [targets = read_fit_targets(options.targets)](const PatchSet& patches, const Points& columns,
                                                                const FitSettings& settings) {
      return fit_patches(patches, columns, targets, settings);
    };
  }
  FitSettings settings = options.settings;
  settings.progress = [&](const std::string& what) { progress.note(what); };
  FreeFormFit fit;
  naming_mesh(options.common, [&] { fit = fit_free_form(source, fit_columns, settings, options.pin, progress); });
  write_outputs(
      options, [&] { write_free_form(options.output, fit.shapes); }, "", fit.report, progress);
  return 0;
}

int run(const FitOptions& options) {
  limit_memory(options.memory_limit);
  const Source source =
      load_source(options.common, {"fit", {SourceKind::mesh, SourceKind::curvatures, SourceKind::patches}});
  const auto geometric = find_geometric_scheme<CurvatureMesh>(options.common.scheme, given_options(options.common));
  for (const auto& [name, weight] : {std::pair{"--thin-plate", options.settings.fairness.thin_plate},
                                     {"--membrane", options.settings.fairness.membrane}})
    if (!(weight >= 0 && std::isfinite(weight)))
      throw InvalidOption(fmt::format("{} {}: it should be a number, 0 or more", name, weight));
  if (options.settings.levels < 0)
    throw InvalidOption(fmt::format("--levels {}: it should be 0 or more", options.settings.levels));
  check_output_path(options.output, all_formats().writers({contents::meshes}));
  if (!options.report.empty()) check_output_path(options.report, all_formats().writers({contents::reports}));
  if (!options.report.empty())
    for (const std::string& mesh : {options.common.mesh, options.output})
      check_not_sidecar("--report", options.report, mesh);
  if (!options.picture.empty()) check_output_path(options.picture, all_formats().writers({contents::pictures}));
  Progress progress(options.common.quiet);
  if (options.cloud.empty() == options.targets.empty())
    throw InvalidOption(
        options.cloud.empty()
            ? "neither --targets IN.csv nor --cloud POINTS; one of them says what the limit shall be near"
            : "both --targets and --cloud; a fit has one of them");
  if (source.kind == SourceKind::patches) return fit_patch_points(options, source, progress);
  if (!options.cloud.empty()) {
    if (geometric)
      throw InvalidOption(options.common.scheme + " takes --targets with normals and curvatures, and no --cloud");
    return fit_to_cloud(options, progress);
  }
  progress.step("reading " + options.targets);
  const FitTargets targets = read_fit_targets(options.targets);  // a wrong header is told before a large mesh is read
  if (geometric) {
    refuse_others(options, "torus-pieces", options.common.scheme.c_str());
    if (targets.by_place)
      throw FormatError(options.targets + ": " + options.common.scheme +
                        " takes targets at vertices; the header should be vertex,x,y,z,nx,ny,nz,k1,k2,d1x,d1y,d1z");
    return fit_geometric(options, targets, *geometric, progress);
  }
  if (targets.by_place)
    refuse_others(options, "places", "targets at places");
  else
    refuse_others(options, "vertices", "targets at vertices");
  return fit_linear(options, progress, [&](const Loaded& loaded, const FitSettings& settings) {
    return (targets.by_place ? fit_scattered : fit_vertices)(*loaded.scheme, loaded.mesh, targets, settings);
  });
}

}  // namespace

Command add_fit(CLI::App& app) {
  auto* command = app.add_subcommand("fit", "Find control points whose limit goes through given points and normals");
  auto options = std::make_shared<FitOptions>();
  FitSettings& settings = options->settings;
  add_mesh(*command, options->common, false);
  add_attributes(*command, options->common);
  add_json(*command, options->common);
  command->get_option("MESH")->description("Control mesh: " + all_formats().readers_in_words({contents::meshes}, "or") +
                                           ", or without -s free-form surfaces (.obj); MESH.json beside a mesh "
                                           "overrides tags");
  command->add_option("--targets", options->targets, "IN.csv: what the limit shall go through, see below");
  command->add_option("--cloud", options->cloud,
                      "Or points without order: a .csv with the header x,y,z[,weight], or the vertices of a mesh");
  command->add_option("--samples", options->samples, "Of a mesh as --cloud: so many points all over its faces instead");
  command->add_option("--seed", options->seed, "Of --samples (default 1)");
  command->add_option("--iterations", settings.iterations, "Of fits to clouds, at most (default 50)");
  command
      ->add_option("-o,--output", options->output, "OUT.obj (with tags, so that `limit` gives the targets) or OUT.ply")
      ->required();
  command->add_option("--report", options->report, "Everything that was found, as data, .json");
  command->add_option("--picture", options->picture, "Before and after, .svg");
  command->add_option(
      "--refine", settings.refine,
      "Refinements that may add control points: auto (as few as needed, 2 at most), or exactly so many");
  command->add_option("--thin-plate", settings.fairness.thin_plate,
                      "Weight of the integral of squared second derivatives: fairer between targets");
  command->add_option("--membrane", settings.fairness.membrane,
                      "Weight of the integral of squared first derivatives: shorter between targets");
  command->add_option("--pin", options->pin,
                      "Of least squares: control points that stay, 3,7 or a CSV with the header vertex[,x,y,z]");
  command->add_flag("--construct", settings.construct,
                    "Of doo-sabin, mid-edge and their like: a plane polygon for each target, no system to solve");
  command->add_option("--size", settings.size, "Of these polygons, between 0 and 1 (default 0.5)");
  command->add_option("-l,--levels", settings.levels, "Of torus-pieces: levels to refine (default 3)");
  command->add_option("--method", options->method, "auto, direct (factorisation) or iterative (conjugate gradients)")
      ->check(CLI::IsMember({"auto", "direct", "iterative"}));
  command->add_flag(
      "--best-effort", settings.best_effort,
      "Where targets cannot all be met, write what comes nearest (default: an error, nothing is written)");
  command->add_flag("--no-rank", options->no_rank, "Leave rank and condition out, which takes time on large meshes");
  add_memory_limit(*command, options->memory_limit);
  command->footer(
      "Examples:\n"
      "  sublimit fit cage.obj --targets points.csv -s catmull-clark -o fitted.obj\n"
      "  sublimit fit cage.obj --targets normals.csv -s loop --thin-plate 1 -o fitted.obj --report fit.json\n"
      "  sublimit limit fitted.obj -s loop --normals -o surface.obj      (its first vertices are the targets)\n"
      "  sublimit fit cage.obj --targets places.csv -s catmull-clark --thin-plate 1e-4 --pin 3,7 -o fitted.obj\n"
      "  sublimit fit cage.obj --cloud scan.ply -s catmull-clark --thin-plate 1e-5 -o fitted.obj\n"
      "  sublimit fit cage.obj --targets normals.csv -s doo-sabin --construct -o fitted.obj\n"
      "  sublimit fit mesh.obj --targets curvatures.csv -s torus-pieces -l 4 -o surface.obj --picture fit.svg\n"
      "  sublimit fit nurbs.obj --targets places.csv --thin-plate 1e-6 -o fitted.obj\n"
      "  sublimit fit nurbs.obj --cloud scan.ply --thin-plate 1e-6 -o fitted.obj\n"
      "\nIN.csv begins with one of these lines:\n"
      "  vertex,x,y,z[,nx,ny,nz[,k1,k2,d1x,d1y,d1z]]   the limit of a vertex of MESH, counted from 0; a normal of any\n"
      "                                                length, or three empty fields\n"
      "  face,u,v,x,y,z[,weight]                       the limit at a place, as in `sublimit sample`: least squares\n"
      "  patch,u,v,x,y,z[,weight]                      the same of free-form surfaces, by their own parameters\n"
      "\nA cloud should lie near the limit of MESH, or near free-form surfaces, which are its first guess.\n"
      "\nPoints alone are as many conditions as there are control points, which may depend on each other (a cube's do);\n"
      "normals are more. Then MESH is refined, and of all control points that meet the targets those nearest to it are\n"
      "taken, or the fairest ones (--thin-plate, --membrane). Under schemes that keep vertices the first ones of OUT are\n"
      "those of MESH, in order. torus-pieces takes everything at every vertex, k1 being the curvature along (d1x, d1y, d1z)\n"
      "and positive where the surface bends towards its normal, and writes refined triangles. Free-form surfaces keep their\n"
      "knots and weights.");
  return [=] {
    for (const CLI::Option* option : command->get_options())
      if (option->count() > 0 && !option->get_lnames().empty())
        options->given["--" + option->get_lnames().front()] =
            option->get_expected_max() == 0 ? "true" : option->as<std::string>();
    options->settings.rank = !options->no_rank;
    options->settings.method = options->method == "direct"      ? FitMethod::direct
                               : options->method == "iterative" ? FitMethod::iterative
                                                                : FitMethod::automatic;
    return run(*options);
  };
}

}  // namespace sublimit::cli
