// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <algorithm>

#include "support/curves.h"
#include "support/free_form.h"
#include "support/normal_surfaces.h"
#include "support/facts.h"
#include "sublimit/core/detail/sparse_product.h"
#include "sublimit/stencils/files/level_files.h"
#include "sublimit/stencils/formats/formats.h"

namespace sublimit::cli {
namespace {

struct LimitOptions {
  Common common;
  int levels = 0;
  bool normals = false;
  std::string output;
};

int limit_vertices(const LimitOptions& options) {
  check_output_path(options.output, all_formats().writers({contents::meshes}));
  Progress progress(options.common.quiet);
  const Loaded loaded = load(options.common, progress);
  std::vector<Level> levels;
  std::vector<FaceVaryingLevel> channel;
  Points limit_values;
  LimitMatrices limit;
  LimitCache cache(*loaded.scheme);
  naming_mesh(options.common, [&] {
    levels = refined_levels(loaded, options.levels, progress);
    progress.step("limits");
    limit = limit_matrices(levels, cache);
    channel = refined_channel(options.common, loaded, levels, options.output);
    if (channel.empty()) return;
    LimitCache channel_cache(face_varying_scheme(*loaded.scheme, loaded.face_varying));
    limit_values = apply(limit_matrices(channel.back().level, channel_cache).position,
                         refined_values(channel, loaded.mesh.face_varying[0].values));
  });
  const Points points = refined_points(levels, loaded.mesh.positions);
  const LimitPoints at_limit = limit_points(limit, levels.back().topology(), points);
  progress.step("writing " + options.output);
  const bool per_corner = all_formats().holds(options.output, MeshField::corner_normals);
  Mesh out = limit_mesh(levels.back(), limit, at_limit,
                        !options.normals ? Normals::none
                        : per_corner     ? Normals::per_corner
                                         : Normals::per_vertex);
  carry_attributes(loaded, levels, out, &limit.position);
  if (!channel.empty()) add_channel(out, channel.back(), loaded.mesh.face_varying[0].name, limit_values);
  write_output(options.common, options.output, out, loaded.mesh, progress);
  Facts facts("limit");
  facts.say(
      "{output}: {points} limit points of level {level}, {types} types of neighbourhood, {without_normal} of {sides} "
      "vertex sides without a normal\n",
      {{"output", options.output},
       {"points", at_limit.position.rows()},
       {"level", options.levels},
       {"types", cache.num_types()},
       {"without_normal", std::count(at_limit.status.begin(), at_limit.status.end(), LimitStatus::undefined_normal)},
       {"sides", at_limit.status.size()}});
  facts.print(options.common);
  return 0;
}

int run(const LimitOptions& options) {
  const Source source = load_source(
      options.common, {"limit", {SourceKind::mesh, SourceKind::curves, SourceKind::normals, SourceKind::patches}});
  switch (source.kind) {
    case SourceKind::curves:
      return limit_curves({&options.common, options.levels, options.output, "", options.normals});
    case SourceKind::normals:
      return write_normal_surface({&source, options.levels, options.output, "", options.normals});
    case SourceKind::patches:
      return limit_free_form(source, options.levels, options.output, options.normals), 0;
    default:
      return limit_vertices(options);
  }
}

}  // namespace

Command add_limit(CLI::App& app) {
  auto* command = app.add_subcommand("limit", "Move the vertices of a level to the limit surface");
  auto options = std::make_shared<LimitOptions>();
  add_mesh(*command, options->common, false);
  add_attributes(*command, options->common);
  command->add_option("-l,--levels", options->levels, "Level whose vertices are moved (default 0, the control mesh)");
  command->add_flag("--normals", options->normals,
                    "Limit normals too: per corner in .obj (one for each side of a crease), per vertex in .ply");
  command->add_option("-o,--output", options->output, "OUT.obj or OUT.ply; faces that are holes are left out")
      ->required();
  add_closed(*command, options->common);
  add_json(*command, options->common);
  command->footer(
      "Examples:\n"
      "  sublimit limit cage.obj -s catmull-clark -l 3 --normals -o surface.obj\n"
      "  sublimit limit cage.obj -s loop -o control_points_at_the_limit.ply\n"
      "  sublimit limit cage.obj -s doo-sabin -l 2 -o surface.ply\n"
      "\nCurves: MESH is a .csv of points or an .obj with lines, OUT a .csv or .obj; --normals adds unit tangents as columns\n"
      "tx,ty,... of a .csv, empty where there is none:\n"
      "  sublimit limit polygon.csv -s four-point -l 4 --normals -o curve.csv\n"
      "\nFree-form surfaces of an .obj, without -s: control points of the nets of a level, moved to where they tend to:\n"
      "  sublimit limit teapot.obj -l 3 --normals -o surface.ply\n"
      "\nhermite-incentre takes points with unit tangents, x,y,tx,ty or x,y,z,tx,ty,tz; its points of a level are on the\n"
      "limit, and are placed on its exact arcs.\n"
      "\nRecipes (.json, see `sublimit construct --help`) stand wherever free-form surfaces do, and, of kinds nielson and\n"
      "piper, meshes with normals, without -s.");
  return [=] { return run(*options); };
}

}  // namespace sublimit::cli
