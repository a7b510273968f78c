// SPDX-License-Identifier: Apache-2.0
// `sublimit step`: limits as files of CAD programs.
#include <fmt/core.h>

#include <memory>
#include <numbers>

#include "commands/step_job.h"
#include "sublimit/base/error.h"
#include "sublimit/cad/limit_model.h"
#include "sublimit/integrals/limit_integrals.h"
#include "sublimit/mesh/detail/attributes.h"
#include "sublimit/stencils/formats/formats.h"

namespace sublimit::cli {
namespace {

/// Without one a hundred-thousandth of the diagonal.
double tolerance_of(const std::string& text, double diagonal) {
  return distance_option("--tolerance", text.empty() ? "0.001%" : text, diagonal);
}

nlohmann::ordered_json report_of(const StepJob& job, const LimitModel& model, const CadFile& file, double tolerance,
                                 const LimitIntegrals& exact) {
  const QuadMeasures& m = model.measures;
  nlohmann::ordered_json json{{"mesh", job.common.mesh},
                              {"scheme", job.common.scheme},
                              {"output", job.output},
                              {"solids", file.solids},
                              {"shells", file.shells},
                              {"valid", file.is_valid},
                              {"faces_before_packing", model.quads},
                              {"faces", model.boundary.faces.size()},
                              {"edges", model.boundary.edges.size()},
                              {"vertices", model.boundary.vertices.rows()},
                              {"caps", model.caps},
                              {"sharp_edges", m.sharp_edges},
                              {"tolerance", tolerance},
                              {"tolerance_met", model.met},
                              {"deviation", model.deviation},
                              {"gap", m.largest_gap},
                              {"angle_between_exact_faces", m.exact_angle},
                              {"angle_at_caps", m.cap_angle},
                              {"angle_between_caps", m.between_caps},
                              {"largest_angle_at", {m.worst[0], m.worst[1], m.worst[2]}},
                              {"area", {{"file", m.area}, {"limit", exact.area}}},
                              {"volume", nullptr}};
  if (file.shells == 0 && exact.solid) json["volume"] = {{"file", m.volume}, {"limit", exact.solid->volume}};
  return json;
}

/// Names of faces: of groups, else of objects, else of materials where files have names.
Mesh::FaceNames names_of(const Mesh& mesh, const std::string& output) {
  Mesh::FaceNames names = mesh.face_names();
  return names.of_face.empty() && all_formats().writes(output, contents::step) ? mesh.materials : names;
}

/// Values of faces that have colours. These are left out, with a note, if STEP cannot have them.
std::vector<Mesh::Values> coloured(const Common& common, const std::string& output, const Mesh& mesh) {
  const auto colours = find_colours(mesh.face_values);
  if (!colours || !all_formats().writes(output, contents::step)) return {};
  for (size_t k = 0; k < 3; ++k) {
    const Mesh::Values& channel = mesh.face_values[size_t((*colours)[k])];
    for (size_t f = 0; f < channel.values.size(); ++f)
      if (const double number = colour_in_unit(channel, f); !(number >= 0 && number <= 1)) {
        if (!common.quiet)
          fmt::print(
              stderr,
              "sublimit: note: {}: colours of faces are left out: '{}' of face {} is not within 0 to 1 (0 to 255 "
              "for bytes)\n",
              output, channel.name, f);
        return {};
      }
  }
  return mesh.face_values;
}

int run(const StepJob& job) {
  const Source source = load_source(job.common, {"step", {SourceKind::mesh, SourceKind::normals, SourceKind::patches}});
  if (source.kind != SourceKind::mesh) return step_patches(job, source);
  tolerance_of(job.tolerance, 1);  // a wrong number is told before the mesh is read
  if (!job.join.empty() && job.join != "g0" && job.join != "g1")
    throw InvalidOption(fmt::format("--join {}: caps join their neighbours by g0 or g1", job.join));
  CadFileEntry* const entry = prepare_step(job);
  Progress progress(job.common.quiet);
  const Loaded loaded = load(job.common, progress);
  const Points& control = loaded.mesh.positions;
  double tolerance = 0;
  if (control.rows() > 0)
    tolerance = tolerance_of(job.tolerance, (control.colwise().maxCoeff() - control.colwise().minCoeff()).norm());
  if (!(tolerance > 0)) throw InvalidMesh(job.common.mesh + ": no extent that --tolerance could be a part of");
  LimitModel model;
  LimitIntegrals exact;
  naming_mesh(job.common, [&] {
    const LimitMap surface(*loaded.scheme, loaded.mesh, loaded.rules);
    progress.step("cutting the limit into patches");
    LimitModelOptions wanted;
    wanted.tolerance = tolerance;
    wanted.join_smoothly = job.join == "g1";
    wanted.pack = !job.no_packing;
    if (loaded.mesh.attributes != Attributes::drop) {
      wanted.face_names = names_of(loaded.mesh, job.output);
      wanted.face_values = coloured(job.common, job.output, loaded.mesh);
    }
    wanted.progress = [&](const std::string& what) { progress.note(what); };
    model = limit_model(surface, control, wanted);
    if (model.boundary.faces.empty()) throw InvalidMesh("no faces to write");
    progress.step("measuring the limit");
    if (!job.report.empty()) exact = limit_integrals(surface, control);
  });
  const CadFile file = cad_file_of(job, entry, model.boundary, progress);
  write_step(job, file, report_of(job, model, file, tolerance, exact), progress);
  const int status = model.met && file.is_valid ? 0 : 1;
  const QuadMeasures& m = model.measures;
  Facts facts("step");
  facts.say(
      "{output}: {solids} solids, {open_shells} open shells; {faces} faces of {patches} patches, {caps} caps; {valid}\n",
      {{"output", job.output},
       {"solids", file.solids},
       {"open_shells", file.shells},
       {"faces", model.boundary.faces.size()},
       {"patches", model.quads},
       {"caps", model.caps},
       valid_fact(file)});
  const auto degrees = [](std::string name, double angle) {
    return three_digits(std::move(name), angle * 180 / std::numbers::pi);
  };
  facts.say(
      "  caps off the limit by {deviation} at most; angles {degrees_at_caps} degrees at their borders, "
      "{degrees_between_caps} between them, {degrees_between_exact_faces} between exact faces\n",
      {three_digits("deviation", model.deviation), degrees("degrees_at_caps", m.cap_angle),
       degrees("degrees_between_caps", m.between_caps), degrees("degrees_between_exact_faces", m.exact_angle)});
  say_unit(facts, job);
  facts.add({three_digits("tolerance", tolerance), {"tolerance_met", model.met, ""}});
  if (!model.met) facts.say("  tolerance {tolerance}: not met\n", {three_digits("tolerance", tolerance)});
  facts.print(job.common);
  return status;
}

}  // namespace

Command add_step(CLI::App& app) {
  auto* command =
      app.add_subcommand("step", "Write limits for CAD: exact B-spline faces, solids where closed (STEP, BREP)");
  auto job = std::make_shared<StepJob>();
  add_mesh(*command, job->common, false);
  add_json(*command, job->common);
  command->add_option("--tolerance", job->tolerance,
                      "Largest distance of caps around extraordinary vertices from the limit: in the mesh's unit, or "
                      "as 0.1% of its diagonal (default 0.001%). Of free-form surfaces: of sides that are one edge "
                      "(default 1e-9 of the diagonal)");
  command->add_option(
      "--join", job->join,
      "How caps join exact faces: g0 (default), or g1, with common tangent planes (schemes of quadrilaterals)");
  command->add_option("--unit", job->unit, "Unit of the coordinates, written into STEP (default mm); numbers stay")
      ->check(CLI::IsMember(std::vector<std::string>{"mm", "m", "inch"}));
  command->add_flag("--no-packing", job->no_packing, "A face for each patch");
  command->add_option("--report", job->report, "OUT.json: faces, deviation, angles, area and volume of file and limit");
  command->add_option("-o,--output", job->output, "OUT.step, OUT.stp or OUT.brep; faces that are holes are left out")
      ->required();
  command->footer(
      "Examples:\n"
      "  sublimit step cage.obj -s catmull-clark -o surface.step\n"
      "  sublimit step cage.obj -s loop --tolerance 0.01% -o surface.brep --report report.json\n"
      "  sublimit step teapot.obj -o teapot.step\n"
      "\nRegular faces are exact, and packed into the largest B-splines that keep knots and smoothness; a triangle of loop is\n"
      "three biquartic patches. Around extraordinary vertices there are rings of exact patches, as many as leave a cap within\n"
      "the tolerance. Creases and borders are edges. Names of groups (else objects, else materials) are those of their faces\n"
      "in STEP files, which have the colours of faces, too (of a .ply, .off or .usda); faces that differ in them stay apart.\n"
      "Schemes without polynomials (butterfly, kobbelt, sqrt3) are refused.\n"
      "\nFree-form surfaces of an .obj and recipes (.json, see `sublimit construct --help`), without -s: a face for each\n"
      "patch, its own B-spline, rational ones with weights, three faces for a Bezier triangle. Sides that are one\n"
      "curve in one parameter are one edge, closed sets of patches solids; names of groups, objects and recipes are those\n"
      "of faces in STEP files. Surfaces that are no B-spline (screw; gregory with twists that differ; nielson) are refused,\n"
      "trimming loops left out. -s piper takes triangles with normals: three Bezier triangles each.");
  return [=] { return run(*job); };
}

}  // namespace sublimit::cli
