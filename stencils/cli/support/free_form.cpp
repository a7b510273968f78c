// SPDX-License-Identifier: Apache-2.0
#include "support/free_form.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <utility>

#include "support/recipes.h"
#include "sublimit/base/detail/memory.h"
#include "sublimit/base/detail/read_file.h"
#include "sublimit/base/error.h"
#include "sublimit/io/detail/file_extension.h"
#include "sublimit/stencils/recipes/detail/recipe_sources.h"

namespace sublimit::cli {

bool is_free_form_job(const Common& common) {
  if (!common.scheme.empty()) return false;
  if (is_recipe_job(common) || has_free_form(common.mesh)) return true;
  throw InvalidOption(
      "-s SCHEME is missing: --scheme is required for meshes (see `sublimit schemes`), but not for an .obj with free-form "
      "curves or surfaces or a .json with recipes; " +
      common.mesh + " is none of these");
}

void refuse_mesh_options(const Common& common) {
  const std::array given{
      std::pair{"--boundary", !common.boundary.empty()},   std::pair{"--creasing", !common.creasing.empty()},
      std::pair{"--triangles", !common.triangles.empty()}, std::pair{"--face-varying", !common.face_varying.empty()},
      std::pair{"--option", !common.options.empty()},      std::pair{"--triangulate", common.triangulate},
      std::pair{"--no-creases", common.no_creases}};
  for (const auto& [name, is_given] : given)
    if (is_given)
      throw InvalidOption(std::string(name) +
                          " is for meshes, which need -s SCHEME; free-form surfaces have no such rule");
}

FreeForm load_free_form(const Common& common) {
  FreeForm shapes = read_free_form(common.mesh);
  if (!common.quiet)
    for (const std::string& warning : shapes.warnings) fmt::print(stderr, "sublimit: warning: {}\n", warning);
  if (shapes.num_faces > 0 && !common.quiet)
    fmt::print(stderr, "sublimit: warning: {}: {} faces of a mesh too, which need -s SCHEME\n", common.mesh,
               shapes.num_faces);
  return shapes;
}

FreeFormPatches load_free_form_patches(const Common& common, const FreeForm& shapes) {
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

LoadedPatches load_patches(const Common& common) {
  if (is_recipe_job(common)) {
    const std::vector<Recipe> recipes = load_recipes(common);
    RecipePatches found = recipe_patches(recipes, common.mesh);
    tell_left_out(common, recipes, Sampled::surfaces);
    return {std::move(found.patches), std::move(found.columns)};
  }
  FreeFormPatches found = load_free_form_patches(common, load_free_form(common));
  return {std::move(found.patches), std::move(found.columns)};
}

LoadedCurves load_patch_curves(const Common& common) {
  if (is_recipe_job(common)) {
    const std::vector<Recipe> recipes = load_recipes(common);
    RecipeCurves found = recipe_curves(recipes, common.mesh);
    tell_left_out(common, recipes, Sampled::curves);
    return {std::move(found.curves), std::move(found.columns), found.coordinates};
  }
  const FreeForm shapes = load_free_form(common);
  FreeFormCurves found = free_form_curves(shapes, common.mesh);
  if (!shapes.surfaces.empty() && !common.quiet)
    fmt::print(stderr, "sublimit: warning: {}: {} surfaces are left out; without --curves they are taken\n",
               common.mesh, shapes.surfaces.size());
  return {std::move(found.curves), std::move(found.columns), found.coordinates};
}

bool has_curves_alone(const Common& common) {
  Common quiet = common;
  quiet.quiet = true;
  if (is_recipe_job(common)) {
    const std::vector<Recipe> recipes = load_recipes(quiet);
    return std::ranges::any_of(recipes, [](const Recipe& recipe) { return recipe.curve() != nullptr; }) &&
           std::ranges::none_of(recipes,
                                [](const Recipe& recipe) { return recipe.surface() || recipe.normal_triangles(); });
  }
  const FreeForm shapes = load_free_form(quiet);
  return !shapes.curves.empty() && shapes.surfaces.empty();
}

bool has_free_form(const std::string& path) {
  if (file_extension(path) != ".obj") return false;
  // What is no file, a pipe, can be read once: by the reader of meshes.
  std::error_code ignored;  // of a name too long, say: its reader tells
  if (const auto status = std::filesystem::status(path, ignored);
      std::filesystem::exists(status) && !std::filesystem::is_regular_file(status))
    return false;
  if (const auto size = static_cast<double>(std::filesystem::file_size(path, ignored)); !ignored)
    check_memory(path + ": " + bytes_in_words(size) + " of text", size, "put it into several files");
  const std::string text = read_file(path);
  for (const std::string_view keyword : {"curv", "surf"})
    for (size_t at = text.find(keyword); at != std::string::npos; at = text.find(keyword, at + 1)) {
      const size_t before = text.find_last_not_of(" \t", at == 0 ? std::string::npos : at - 1);
      const bool begins = at == 0 || before == std::string::npos || text[before] == '\n' || text[before] == '\r';
      const char after = at + 4 < text.size() ? text[at + 4] : ' ';
      if (begins && (after == ' ' || after == '\t' || after == '2' || after == '\n')) return true;
    }
  return false;
}

}  // namespace sublimit::cli
