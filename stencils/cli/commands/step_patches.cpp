// SPDX-License-Identifier: Apache-2.0
// `sublimit step` of patches: free-form surfaces, recipes, triangles with normals.
#include <fmt/core.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <iterator>
#include <numbers>

#include "support/free_form.h"
#include "support/normal_surfaces.h"
#include "support/recipes.h"
#include "commands/step_job.h"
#include "sublimit/base/error.h"
#include "sublimit/cad/patch_model.h"
#include "sublimit/cad/piper_patches.h"
#include "sublimit/stencils/recipes/detail/recipe_sources.h"

namespace sublimit::cli {
namespace {

std::string name_of(const FreeForm& shapes, const FreeFormSurface& surface) {
  const Index named = surface.group >= 0 ? surface.group : surface.object;
  return named >= 0 ? shapes.names[size_t(named)] : std::string();
}

std::vector<NamedPatch> free_form_surfaces(const Source& source) {
  tell_warnings(source);
  const FreeForm& shapes = *source.shapes;
  const FreeFormPatches found = free_form_patches_of(source);
  std::vector<NamedPatch> patches;
  for (size_t p = 0; p < shapes.surfaces.size(); ++p)
    patches.push_back({found.patches.members()[p].patch, found.patches.columns_of(p, found.columns),
                       found.patches.coordinates(), name_of(shapes, shapes.surfaces[p]),
                       fmt::format("{}:{}: patch {}", source.common.mesh, found.line[p], p)});
  return patches;
}

std::vector<NamedPatch> normal_triangles(const NormalSurface& surface, const std::string& name) {
  if (surface.scheme.name != "piper")
    throw UnsupportedTopology(surface.common.mesh + ": " + surface.scheme.name +
                              " is no B-spline, and CAD files have no other surface for it; piper is a polynomial "
                              "surface through the same points and normals");
  return piper_patches(surface.data, name, surface.common.mesh);
}

/// Nets where a kind has one: a polynomial by points is a B-spline then.
std::vector<NamedPatch> recipe_surfaces(const Source& source, Progress& progress) {
  const Common& common = source.common;
  tell_warnings(source);
  const std::vector<Recipe>& recipes = *source.recipes;
  std::vector<NamedPatch> patches;
  for (const Recipe& recipe : recipes) {
    if (const RecipeSurface* const surface = recipe.surface()) {
      NamedPatch patch{surface->patch, surface->columns, surface->coordinates,
                       recipe.name,    recipe.place,     surface->no_net};
      if (surface->net)
        patch.patch = surface->net->surface, patch.columns = surface->net->columns,
        patch.coordinates = surface->net->coordinates;
      patches.push_back(std::move(patch));
    } else if (recipe.normal_triangles()) {
      std::ranges::move(normal_triangles(load_normal_surface(common, recipe, progress), recipe.name),
                        std::back_inserter(patches));
    }
  }
  if (patches.empty()) (void)recipe_patches(recipes, common.mesh);  // tells what there is instead
  tell_left_out(source, Sampled::all_surfaces);
  return patches;
}

std::vector<NamedPatch> load_surfaces(const Source& source, Progress& progress) {
  if (source.recipes) return recipe_surfaces(source, progress);
  if (source.kind == SourceKind::normals) return normal_triangles(load_normal_surfaces(source, progress)[0], "");
  return free_form_surfaces(source);
}

double diagonal_of(const std::vector<NamedPatch>& patches) {
  Eigen::AlignedBox3d box;
  for (const NamedPatch& patch : patches) {
    const Points points = points_in_space(patch.columns);
    for (Eigen::Index i = 0; i < points.rows(); ++i) box.extend(Eigen::Vector3d(points.row(i)));
  }
  return box.isEmpty() ? 0 : box.diagonal().norm();
}

nlohmann::ordered_json report_of(const StepJob& job, const PatchModel& model, const CadFile& file, size_t patches) {
  nlohmann::ordered_json json{{"file", job.common.mesh},
                              {"output", job.output},
                              {"solids", file.solids},
                              {"shells", file.shells},
                              {"valid", file.is_valid},
                              {"patches", patches},
                              {"faces", model.boundary.faces.size()},
                              {"edges", model.boundary.edges.size()},
                              {"vertices", model.boundary.vertices.rows()},
                              {"shared_edges", model.shared},
                              {"seam_edges", model.seams},
                              {"point_sides", model.points},
                              {"open_sides", model.open},
                              {"partial_sides", model.partial},
                              {"reparametrised_sides", model.reparametrised},
                              {"non_manifold_sides", model.non_manifold},
                              {"unsuitable_sides", model.unsuitable},
                              {"gap", model.gap},
                              {"angle", model.angle},
                              {"largest_angle_at", model.angle_at},
                              {"area", model.area},
                              {"volume", nullptr}};
  if (file.solids > 0) json["volume"] = file.volume;
  return json;
}

void refuse_limit_options(const StepJob& job) {
  if (!job.join.empty()) throw InvalidOption("--join is for caps of subdivision limits; patches have none");
  if (job.no_packing) throw InvalidOption("--no-packing is for subdivision limits; each patch is a face as it is");
}

}  // namespace

int step_patches(const StepJob& job, const Source& source) {
  refuse_limit_options(job);
  if (!job.tolerance.empty()) distance_option("--tolerance", job.tolerance, 1);
  CadFileEntry* const entry = prepare_step(job);
  Progress progress(job.common.quiet);
  const std::vector<NamedPatch> patches = load_surfaces(source, progress);
  progress.step("joining patches");
  PatchModelOptions options;
  if (const double diagonal = diagonal_of(patches); !job.tolerance.empty() && diagonal > 0)
    options.same = distance_option("--tolerance", job.tolerance, diagonal) / diagonal;
  PatchModel model = patch_model(patches, options);
  const CadFile file = cad_file_of(job, entry, model.boundary, progress);
  write_step(job, file, report_of(job, model, file, patches.size()), progress);
  const int status = file.is_valid ? 0 : 1;
  Facts facts("step");
  facts.say("{output}: {solids} solids, {open_shells} open shells; {faces} faces of {patches} patches; {valid}\n",
            {{"output", job.output},
             {"solids", file.solids},
             {"open_shells", file.shells},
             {"faces", model.boundary.faces.size()},
             {"patches", patches.size()},
             valid_fact(file)});
  facts.say(
      "  {shared_edges} edges shared by two faces, {seam_edges} seams, {point_sides} sides that are a point, {open_sides} "
      "sides open; gap {gap} and angle {degrees} degrees at most\n",
      {{"shared_edges", model.shared},
       {"seam_edges", model.seams},
       {"point_sides", model.points},
       {"open_sides", model.open},
       three_digits("gap", model.gap),
       three_digits("degrees", model.angle * 180 / std::numbers::pi)});
  say_unit(facts, job);
  const std::int64_t apart = model.partial + model.reparametrised + model.non_manifold + model.unsuitable;
  if (apart > 0)
    facts.say(
        "  not joined: {reparametrised_sides} sides of one shape in different parameters, {partial_sides} pairs with parts "
        "of that kind, {non_manifold_sides} curves of three sides or more, {unsuitable_sides} pairs that turn a front over\n",
        {{"reparametrised_sides", model.reparametrised},
         {"partial_sides", model.partial},
         {"non_manifold_sides", model.non_manifold},
         {"unsuitable_sides", model.unsuitable}});
  facts.print(job.common);
  return status;
}

}  // namespace sublimit::cli
