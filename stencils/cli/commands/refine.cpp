// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <vector>

#include "sublimit/base/error.h"
#include "sublimit/stencils/files/level_files.h"
#include "sublimit/stencils/formats/formats.h"
#include "sublimit/stencils/formats/matrix_market.h"
#include "support/curves.h"
#include "support/free_form.h"
#include "support/normal_surfaces.h"
#include "support/facts.h"

namespace sublimit::cli {
namespace {

struct RefineOptions {
  Common common;
  int levels = 1;
  std::string output, matrix;
  bool no_tags = false;
};

int refine_mesh(const RefineOptions& options) {
  check_output_path(options.output, all_formats().writers({contents::meshes}));
  if (!options.matrix.empty()) check_output_path(options.matrix, all_formats().writers({contents::matrices}));
  Progress progress(options.common.quiet);
  const Loaded loaded = load(options.common, progress);
  std::vector<FaceVaryingLevel> channel;
  Mesh out;
  if (options.matrix.empty() && !has_channel(loaded, options.output)) {
    naming_mesh(options.common, [&] {
      out = refined_positions(loaded, options.levels, telling_levels(progress, options.levels));
      if (options.no_tags) out = without_tags(std::move(out));
    });
    progress.step("writing " + options.output);
  } else {
    std::vector<Level> levels;
    naming_mesh(options.common, [&] {
      levels = refined_levels(loaded, options.levels, progress);
      channel = refined_channel(options.common, loaded, levels, options.output);
    });
    // The matrix first: if it does not fit, there is no mesh without its matrix.
    if (!options.matrix.empty()) {
      progress.step("multiplying");
      write_matrix_market(options.matrix, refinement_matrix(levels));
    }
    progress.step("writing " + options.output);
    out = level_output(levels.back(), refined_points(levels, loaded.mesh.positions), loaded.mesh, loaded.rules,
                       !options.no_tags);
    carry_attributes(loaded, levels, out);
  }
  if (!channel.empty()) {
    add_channel(out, channel.back(), loaded.mesh.face_varying[0].name,
                refined_values(channel, loaded.mesh.face_varying[0].values));
    if (!options.no_tags) out.face_varying_interpolation = loaded.face_varying;
  }
  write_output(options.common, options.output, out, loaded.mesh, progress);
  if (!options.common.json) return 0;
  Facts facts("refine");  // there is nothing to say
  facts.add({{"output", options.output},
             {"level", options.levels},
             {"vertices", out.num_vertices()},
             {"faces", out.num_faces()}});
  facts.print(options.common);
  return 0;
}

int run(const RefineOptions& options) {
  const Source source = load_source(
      options.common, {"refine", {SourceKind::mesh, SourceKind::curves, SourceKind::normals, SourceKind::patches}});
  switch (source.kind) {
    case SourceKind::curves:
      return refine_curves({&options.common, options.levels, options.output, options.matrix});
    case SourceKind::normals:
      return write_normal_surface({&source, options.levels, options.output, options.matrix, true, "refine"});
    case SourceKind::patches:
      if (options.no_tags) throw InvalidOption("--no-tags is for meshes; free-form surfaces have no tags");
      return refine_free_form(source, options.levels, options.output, options.matrix), 0;
    default:
      return refine_mesh(options);
  }
}

}  // namespace

Command add_refine(CLI::App& app) {
  auto* command = app.add_subcommand("refine", "Refine a mesh or curves");
  auto options = std::make_shared<RefineOptions>();
  add_mesh(*command, options->common, false);
  add_attributes(*command, options->common);
  command->add_option("-l,--levels", options->levels, "Levels of refinement")->required();
  command->add_option("-o,--output", options->output, "OUT.obj (with tags, so that refining can go on) or OUT.ply")
      ->required();
  command->add_option("--matrix", options->matrix, "OUT.mtx: the stencils, new points = matrix * control points");
  command->add_flag("--no-tags", options->no_tags, "Leave the tags out");
  add_closed(*command, options->common);
  add_json(*command, options->common);
  command->footer(
      "Examples:\n"
      "  sublimit refine cage.obj -s catmull-clark -l 2 -o refined.obj\n"
      "  sublimit refine cage.obj -s loop -l 3 -o refined.ply --matrix stencils.mtx\n"
      "  sublimit refine cage.obj -s catmull-clark -l 2 --face-varying boundaries -o refined.obj\n"
      "\nCurves: MESH is a .csv of points (a line each; a blank line begins another curve) or an .obj with lines, OUT a .csv or .obj:\n"
      "  sublimit refine polygon.csv -s chaikin -l 3 --closed -o curve.csv\n"
      "\nFree-form surfaces of an .obj, without -s: the middle of every span becomes a knot; OUT.obj has the finer nets as\n"
      "bspline surfaces, OUT.ply their polygons:\n"
      "  sublimit refine teapot.obj -l 2 -o nets.obj --matrix S.mtx\n"
      "\nhermite-incentre takes and writes points with unit tangents, x,y,tx,ty or x,y,z,tx,ty,tz; it has no matrix.\n"
      "\nnielson, piper: points of their surface with normals, which are those of `limit`; nothing refines them further:\n"
      "  sublimit refine triangles.obj -s nielson -l 3 -o surface.obj\n"
      "\nRecipes (.json, see `sublimit construct --help`) stand wherever such surfaces do, without -s.");
  return [=] { return run(*options); };
}

}  // namespace sublimit::cli
