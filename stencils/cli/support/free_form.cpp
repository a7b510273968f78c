// SPDX-License-Identifier: Apache-2.0
#include "support/free_form.h"

#include <fmt/core.h>

#include <algorithm>
#include <utility>

#include "support/recipes.h"
#include "sublimit/stencils/recipes/detail/recipe_sources.h"

namespace sublimit::cli {

void tell_warnings(const Source& source) {
  const Common& common = source.common;
  if (common.quiet) return;
  if (source.recipes) tell_notes(*source.recipes);
  if (!source.shapes) return;
  for (const std::string& warning : source.shapes->warnings) fmt::print(stderr, "sublimit: warning: {}\n", warning);
  if (source.shapes->num_faces > 0)
    fmt::print(stderr, "sublimit: warning: {}: {} faces of a mesh too, which need -s SCHEME\n", common.mesh,
               source.shapes->num_faces);
}

FreeFormPatches free_form_patches_of(const Source& source) {
  const Common& common = source.common;
  const FreeForm& shapes = *source.shapes;
  FreeFormPatches found = free_form_patches(shapes, common.mesh);
  if (!shapes.curves.empty() && !common.quiet)
    fmt::print(stderr, "sublimit: warning: {}: {} curves are left out; `sample` takes them with --curves\n",
               common.mesh, shapes.curves.size());
  const auto trimmed = std::ranges::count_if(shapes.surfaces, is_trimmed);
  if (trimmed > 0 && !common.quiet)
    fmt::print(stderr, "sublimit: warning: {}: {} of {} surfaces have trimming loops; they are taken untrimmed\n",
               common.mesh, trimmed, shapes.surfaces.size());
  return found;
}

LoadedPatches load_patches(const Source& source) {
  tell_warnings(source);
  if (source.recipes) {
    RecipePatches found = recipe_patches(*source.recipes, source.common.mesh);
    tell_left_out(source, Sampled::surfaces);
    return {std::move(found.patches), std::move(found.columns)};
  }
  FreeFormPatches found = free_form_patches_of(source);
  return {std::move(found.patches), std::move(found.columns)};
}

LoadedCurves load_patch_curves(const Source& source) {
  const Common& common = source.common;
  tell_warnings(source);
  if (source.recipes) {
    RecipeCurves found = recipe_curves(*source.recipes, common.mesh);
    tell_left_out(source, Sampled::curves);
    return {std::move(found.curves), std::move(found.columns), found.coordinates};
  }
  FreeFormCurves found = free_form_curves(*source.shapes, common.mesh);
  if (!source.shapes->surfaces.empty() && !common.quiet)
    fmt::print(stderr, "sublimit: warning: {}: {} surfaces are left out; without --curves they are taken\n",
               common.mesh, source.shapes->surfaces.size());
  return {std::move(found.curves), std::move(found.columns), found.coordinates};
}

}  // namespace sublimit::cli
