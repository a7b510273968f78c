// SPDX-License-Identifier: Apache-2.0
// `sublimit implicit`: fields at places, and control meshes whose limit is their level set.
#include <fmt/core.h>

#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>

#include "support/common.h"
#include "support/loaded_library.h"
#include "support/memory_limit.h"
#include "support/facts.h"
#include "openvdb/entry.h"
#include "sublimit/base/detail/atomic_file.h"
#include "sublimit/base/error.h"
#include "sublimit/implicit/detail/level_set_mesh.h"
#include "sublimit/io/write_mesh.h"
#include "sublimit/stencils/files/field_samples.h"
#include "sublimit/stencils/files/level_files.h"
#include "sublimit/stencils/formats/formats.h"
#include "sublimit/stencils/picture/picture_mesh.h"
#include "sublimit/stencils/recipes/detail/field_recipe.h"

namespace sublimit::cli {
namespace {

constexpr Index most_drawn_faces = 20'000;

struct ImplicitJob {
  Common common;
  std::string at, output, report, picture, memory_limit;
  std::optional<int> cells;
  std::optional<double> tolerance;
};

Polygonizer polygonizer() {
  void* const entry =
      loaded_function(implicit_mesh_part, openvdb_library, polygonize_entry, "control meshes of fields");
  return [polygonize = reinterpret_cast<PolygonizeEntry*>(entry)](const FieldGrid& grid) {
    Mesh mesh;
    polygonize(grid, mesh);
    return mesh;
  };
}

/// What is wrong with a field is wrong with its file.
void naming_field(const FieldJob& field, const std::function<void()>& body) {
  try {
    body();
  } catch (const InvalidParameter& error) {
    throw FormatError(field.place + ": " + error.what());
  } catch (const InvalidMesh& error) {
    throw InvalidMesh(field.place + ": " + error.what());
  } catch (const ResourceError& error) {
    throw ResourceError(field.place + ": " + error.what());
  }
}

nlohmann::ordered_json words(const LevelSetAttempt& attempt) {
  const LevelSetError& e = attempt.error;
  return {{"cells", attempt.cells},
          {"splits", attempt.splits},
          {"faces", attempt.faces},
          {"samples", e.samples},
          {"largest_distance", e.largest},
          {"mean_distance", e.mean},
          {"largest_angle", e.largest_angle},
          {"mean_angle", e.mean_angle},
          {"curvature_samples", e.curvatures},
          {"mean_gauss_difference", e.gauss},
          {"mean_mean_curvature_difference", e.mean_curvature}};
}

nlohmann::ordered_json words(const ClosedMeshCounts& counts) {
  return {{"euler_characteristic", counts.euler}, {"components", counts.components}};
}

std::string report(const ImplicitJob& job, const FieldJob& field, const LevelSetMesh& mesh) {
  nlohmann::ordered_json json{{"field", job.common.mesh},
                              {"kind", field.name},
                              {"scheme", job.common.scheme},
                              {"output", job.output},
                              {"tolerance", mesh.tolerance},
                              {"met", mesh.met()},
                              {"diagonal", mesh.diagonal},
                              {"cell", mesh.cell},
                              {"field_range", {mesh.least, mesh.largest}},
                              {"vertices", mesh.cage.num_vertices()},
                              {"faces", mesh.cage.num_faces()},
                              {"creases", mesh.cage.creases.size()},
                              {"corners", mesh.cage.corners.size()},
                              {"topology", words(mesh.counts)},
                              {"topology_of_twice_as_many_cells", nullptr},
                              {"result", words(mesh.attempt)},
                              {"attempts", nlohmann::ordered_json::array()},
                              {"notes", mesh.notes}};
  if (mesh.fine_counts) json["topology_of_twice_as_many_cells"] = words(*mesh.fine_counts);
  for (const LevelSetAttempt& attempt : mesh.attempts) json["attempts"].push_back(words(attempt));
  return json.dump(2) + "\n";
}

std::string picture(const Scheme<double>& scheme, const LevelSetMesh& mesh) {
  Level level = control_level(scheme, mesh.cage);
  Points points = mesh.cage.positions;
  const PictureMesh cage = wire_picture(level, points);
  while (level.topology().num_faces() * 4 <= most_drawn_faces) {
    level = next_level(scheme, level);
    points = level.S * points;
  }
  LimitCache types(scheme);
  const LimitMatrices limit = limit_matrices(level, types);
  const PictureMesh surface =
      surface_picture(limit_mesh(level, limit, limit_points(limit, level.topology(), points), Normals::per_corner));
  return svg_picture(
      {{{cage}, "control mesh", fmt::format("{} faces", mesh.cage.num_faces())}, {{surface}, "limit", scheme.name}});
}

void write_whole(const std::string& path, const std::string& text) {
  AtomicFile file(path);
  file.write(text);
  file.commit();
}

int sample_places(const ImplicitJob& job, const FieldJob& field, Progress& progress) {
  check_output_path(job.output, all_formats().writers({contents::rows, contents::arrays}));
  progress.step("evaluating");
  const std::int64_t count = write_field_samples(job.at, job.output, *field.field, [&](std::int64_t done) {
    progress.note(fmt::format("evaluating, {} places done", done));
  });
  progress.step("");
  Facts facts("implicit");
  facts.say("{output}: {places} places of {field}\n",
            {{"output", job.output}, {"places", count}, {"field", field.name}});
  facts.print(job.common);
  return 0;
}

int make_mesh(const ImplicitJob& job, const FieldJob& field, Progress& progress) {
  check_output_path(job.output, all_formats().holders(MeshField::creases));
  if (!job.report.empty()) check_output_path(job.report, all_formats().writers({contents::reports}));
  if (!job.report.empty()) check_not_sidecar("--report", job.report, job.output);
  if (!job.picture.empty()) check_output_path(job.picture, all_formats().writers({contents::pictures}));
  const Scheme<double> scheme = scheme_or_throw(job.common.scheme, given_options(job.common));
  LevelSetOptions options{.box = field.box, .cells = job.cells.value_or(field.cells)};
  options.tolerance = job.tolerance.value_or(0);
  options.progress = [&](const std::string& what) { progress.note(what); };
  LevelSetMesh mesh;
  std::string drawn;
  progress.step("sampling the field");
  naming_field(field, [&] { mesh = level_set_mesh(field.field, scheme, polygonizer(), options); });
  if (!job.picture.empty()) {
    progress.step("drawing " + job.picture);
    drawn = picture(scheme, mesh);
  }
  progress.step("writing " + job.output);
  write_mesh(job.output, mesh.cage, progress.bytes_written());
  if (!job.report.empty()) write_whole(job.report, report(job, field, mesh));
  if (!job.picture.empty()) write_whole(job.picture, drawn);
  progress.step("");
  const LevelSetError& e = mesh.attempt.error;
  Facts facts("implicit");
  facts.say(
      "{output}: {faces} faces, {creases} creases, {corners} corners, Euler characteristic {euler_characteristic}, "
      "{components} components ({cells} cells, split {splits} times)\n",
      {{"output", job.output},
       {"faces", mesh.cage.num_faces()},
       {"creases", mesh.cage.creases.size()},
       {"corners", mesh.cage.corners.size()},
       {"euler_characteristic", mesh.counts.euler},
       {"components", mesh.counts.components},
       {"cells", mesh.attempt.cells},
       {"splits", mesh.attempt.splits}});
  facts.say(
      "  limit off the surface by {largest_distance} at most, {mean_distance} in the mean; normals by {largest_angle} "
      "and {mean_angle} rad\n",
      {three_digits("largest_distance", e.largest), three_digits("mean_distance", e.mean),
       three_digits("largest_angle", e.largest_angle), three_digits("mean_angle", e.mean_angle)});
  facts.say("  tolerance {tolerance}: {tolerance_met}\n",
            {three_digits("tolerance", mesh.tolerance),
             {"tolerance_met", mesh.met(), mesh.met() ? "met" : "not met; take more --cells or a larger --tolerance"}});
  std::string notes;
  for (const std::string& note : mesh.notes) notes += "  note: " + note + "\n";
  facts.say("{notes}", {{"notes", mesh.notes, notes}});
  facts.print(job.common);
  return mesh.met() ? 0 : 1;
}

int run(const ImplicitJob& job) {
  limit_memory(job.memory_limit);
  limit_threads(job.common);
  if (job.cells && *job.cells < 4) throw InvalidOption(fmt::format("--cells {}: it should be 4 or more", *job.cells));
  if (job.tolerance && !(*job.tolerance > 0 && std::isfinite(*job.tolerance)))
    throw InvalidOption(fmt::format("--tolerance {}: it should be a length, more than 0", *job.tolerance));
  Progress progress(job.common.quiet);
  const FieldJob field = read_field_job(job.common.mesh);
  if (job.at.empty()) return make_mesh(job, field, progress);
  for (const auto& [option, given] : {std::pair{"--cells", job.cells.has_value()},
                                      {"--tolerance", job.tolerance.has_value()},
                                      {"--report", !job.report.empty()},
                                      {"--picture", !job.picture.empty()}})
    if (given) throw InvalidOption(fmt::format("{} is not for --at; leave it out", option));
  return sample_places(job, field, progress);
}

}  // namespace

Command add_implicit(CLI::App& app) {
  auto* command =
      app.add_subcommand("implicit", "Evaluate implicit surfaces, or make control meshes of their level sets");
  auto job = std::make_shared<ImplicitJob>();
  job->common.scheme = "catmull-clark";
  command->add_option("FIELD", job->common.mesh, "A recipe of kind implicit, .json, or a field {\"field\": ..}")
      ->required();
  command->add_option("-s,--scheme", job->common.scheme, "Whose limit is fitted (default catmull-clark)");
  command->add_option("--option", job->common.options, "An option of the scheme, name=value");
  command->add_option("--at", job->at, "IN.csv with the header x,y,z: the field there, and no mesh");
  command->add_option("--cells", job->cells, "Along the longest side of the box (default: as few as show the shape)");
  command->add_option("--tolerance", job->tolerance,
                      "Largest distance of the limit, a length (default: 1e-4 of the box's diagonal)");
  command->add_option("-o,--output", job->output, "CAGE.obj with creases as tags; with --at OUT.csv")->required();
  command->add_option("--report", job->report, "Everything that was found, as data, .json");
  command->add_option("--picture", job->picture, "Control mesh and limit, .svg");
  add_json(*command, job->common);
  add_run(*command, job->common);
  add_memory_limit(*command, job->memory_limit);
  std::string names;
  for (const std::string& name : field_names()) names += (names.empty() ? "" : ", ") + name;
  command->footer(
      "Examples:\n"
      "  sublimit implicit torus.json -o cage.obj --report report.json --picture torus.svg\n"
      "  sublimit implicit torus.json -s loop --cells 12 --tolerance 1e-3 -o cage.obj\n"
      "  sublimit implicit torus.json --at places.csv -o values.csv\n"
      "\nA field is negative inside:\n"
      "  {\"kind\": \"implicit\", \"field\": \"distance-circle\", \"center\": [0, 0, 0], \"normal\": [0, 0, 1], \"ring\": 1,\n"
      "   \"radius\": 0.4, \"box\": [[-2, -2, -1], [2, 2, 1]]}\n"
      "\nFields: " +
      names + "\n\nbox and cells may be left out where the field has an extent.");
  return [=] { return run(*job); };
}

}  // namespace sublimit::cli
