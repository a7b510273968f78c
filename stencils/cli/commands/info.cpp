// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "support/common.h"
#include "support/free_form.h"
#include "support/mesh_facts.h"
#include "support/normal_surfaces.h"
#include "support/recipes.h"
#include "sublimit/stencils/jobs/detail/mesh_info_json.h"

namespace sublimit::cli {
namespace {

std::string to_text(const Eigen::Vector3d& x) { return fmt::format("({}, {}, {})", x[0], x[1], x[2]); }

/// Nothing where only rounding is left.
std::string plus_minus(double error) { return error > 0 ? fmt::format(" (+- {:.1e})", error) : ""; }

void print(const LimitIntegrals& limit) {
  fmt::print("  area               {}{}\n", limit.area, plus_minus(limit.area_error));
  if (limit.centroid)
    fmt::print("    centroid         {}{}\n", to_text(*limit.centroid), plus_minus(limit.centroid_error));
  if (!limit.solid) {
    fmt::print("  volume             none: {}\n", limit.why_no_solid);
    return;
  }
  const SolidIntegrals& solid = *limit.solid;
  fmt::print("  volume             {}{}\n", solid.volume, plus_minus(solid.volume_error));
  fmt::print("    centroid         {}{}\n", to_text(solid.centroid), plus_minus(solid.centroid_error));
  for (int i = 0; i < 3; ++i)
    fmt::print("    {:<16} {}{}\n", i == 0 ? "inertia" : "", to_text(solid.inertia.row(i).transpose()),
               i == 0 ? plus_minus(solid.inertia_error) : "");
}

void print(const MeshInfo& info, const std::string& name) {
  print_counts(info, name, "sublimit");
  for (const MeshInfo::Channel& channel : info.channels)
    fmt::print("  face-varying       {}: {} values of {} numbers, interpolation {}\n", channel.name, channel.values,
               channel.numbers, info.face_varying);
  print_verdict(info);
  for (size_t k = 0; k < info.predicted_bytes.size(); ++k)
    fmt::print("    to level {}         about {:.1f} MB\n", k + 1, info.predicted_bytes[k] / 1e6);
  if (info.limit) print(*info.limit);
  print_warnings(info);
  constexpr size_t most = 20;
  for (size_t i = 0; i < std::min(info.faults.size(), most); ++i) fmt::print("  fault: {}\n", info.faults[i]);
  if (info.faults.size() > most) fmt::print("  and {} faults more (--json lists all)\n", info.faults.size() - most);
  if (info.faults.empty()) fmt::print("  no faults: a consistently wound manifold\n");
}

LimitIntegrals patch_integrals(const Source& source) {
  limit_threads(source.common);
  Progress progress(source.common.quiet);
  LoadedPatches loaded = load_patches(source);
  LimitIntegrals integrals;
  naming_mesh(source.common, [&] {
    progress.step("integrating over the patches");
    integrals = limit_integrals(Patches(std::move(loaded.patches), std::move(loaded.columns)));
  });
  progress.step("");
  return integrals;
}

int run(const Common& common, bool as_json, bool limit) {
  const Takes any{"info", {SourceKind::mesh, SourceKind::normals, SourceKind::patches}, true};
  const Takes integrable{"info --limit", {SourceKind::mesh, SourceKind::patches}};
  const Source source = load_source(common, limit ? integrable : any);
  if (source.has_shapes()) {
    std::optional<LimitIntegrals> integrals;
    if (limit) integrals = patch_integrals(source);
    if (source.recipes)
      print_recipes(source, as_json, integrals);
    else
      print_free_form(common, *source.shapes, as_json, integrals);
    if (integrals && !as_json) print(*integrals);
    if (limit || as_json || source.recipes || source.shapes->num_faces == 0) return 0;
  }
  Common quiet = common;
  quiet.quiet = true;
  Progress progress(common.quiet);
  const bool normals = source.kind == SourceKind::normals;
  if (normals) {
    quiet.scheme.clear();
    quiet.options.clear();
  }
  const Loaded loaded = load(quiet, progress);  // warnings and faults are what this subcommand prints
  progress.step("");
  if (!common.quiet)
    for (const std::string& note : loaded.notes) fmt::print(stderr, "sublimit: note: {}\n", note);
  MeshInfo info = mesh_info(loaded, normals);
  if (limit && info.why_not.empty()) {
    progress.step("integrating over the limit");
    naming_mesh(common, [&] { info.limit = limit_integrals(loaded); });
    progress.step("");
  }
  if (normals) {
    info.scheme = common.scheme;
    info.why_not = why_no_normal_surface(common, loaded.mesh);
  }
  if (as_json)
    fmt::print("{}\n", to_json(info, common.mesh).dump(2));
  else
    print(info, common.mesh);
  return info.why_not.empty() ? 0 : 1;  // whether the scheme takes the mesh is a question, and the answer may be no
}

}  // namespace

Command add_info(CLI::App& app) {
  auto* command = app.add_subcommand("info", "Report counts, valences, boundaries, tags and every fault of a mesh");
  auto common = std::make_shared<Common>();
  auto as_json = std::make_shared<bool>(false);
  auto limit = std::make_shared<bool>(false);
  add_mesh(*command, *common, false);
  command->add_flag(
      "--limit", *limit,
      "Area of the limit (with -s), or of patches; of closed surfaces volume, centroid and inertia of the solid; errors "
      "where more than rounding is left");
  command->add_flag("--json", *as_json, "As JSON");
  command->footer(
      "Examples:\n  sublimit info cage.obj\n  sublimit info cage.obj -s loop --json\n"
      "  sublimit info cage.obj -s catmull-clark --limit\n  sublimit info nurbs.obj --limit\n"
      "\nOf an .obj with free-form curves and surfaces: bases, degrees, knots, continuity, weights, collapsed sides, trims.\n"
      "Of recipes (.json): kinds, faces or segments, control points, whether there is an exact net.");
  return [=] { return run(*common, *as_json, *limit); };
}

}  // namespace sublimit::cli
