// SPDX-License-Identifier: Apache-2.0
// Any bytes as recipes: an Error that says where, or curves and surfaces that have points, nets whose text reads back,
// and fields that have values. Never a crash.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <span>
#include <string_view>

#include "sublimit/base/error.h"
#include "sublimit/stencils/recipes/detail/field_recipe.h"
#include "sublimit/stencils/recipes/detail/net_file.h"
#include "sublimit/stencils/recipes/detail/recipe.h"

namespace sublimit {
namespace {

void require_recipe(bool holds) {
  if (!holds) std::abort();
}

void check_recipe(const Recipe& recipe) {
  if (const RecipeCurve* const curve = recipe.curve()) {
    const CurvePlace places[] = {{0, 0}, {curve->curve->num_segments() - 1, 0.7}};
    const CurveSamples at = curve->curve->evaluate(curve->columns, places, 2, curve->coordinates);
    require_recipe(at.position.rows() == 2);
  }
  if (const RecipeSurface* const surface = recipe.surface()) {
    const Place places[] = {{0, 0, 0}, {surface->patch->faces().size - 1, 0.25, 0.5}};
    const LimitSamples at = surface->patch->evaluate(surface->columns, places, 2, surface->coordinates);
    require_recipe(at.position.rows() == 2);
  }
}

void check_field(std::string_view text) {
  FieldJob job;
  try {
    job = parse_field_job(text, "fuzz.json");
  } catch (const Error& error) {
    require_recipe(std::string_view(error.what()).starts_with("fuzz.json:"));
    return;
  }
  require_recipe(job.field != nullptr);
  for (const Eigen::Vector3d& x : {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(.5, -.25, 2)}) {
    const FieldJet jet = job.field->jet(x);
    require_recipe(jet.order >= 0 && jet.order <= 2);
  }
  if (const auto box = job.field->extent()) require_recipe(box->isEmpty() || !(box->sizes().minCoeff() < 0));
}

void check_recipes(std::string_view text) {
  std::vector<Recipe> recipes;
  try {
    recipes = parse_recipes(text, "fuzz.json");
  } catch (const Error& error) {
    require_recipe(std::string_view(error.what()).starts_with("fuzz.json:"));
    return;
  }
  for (const Recipe& recipe : recipes) check_recipe(recipe);
  FreeForm nets;
  try {
    nets = net_file(recipes);
  } catch (const UnsupportedTopology& error) {
    require_recipe(std::string_view(error.what()).starts_with("fuzz.json:"));
    return;
  }
  std::string written;
  try {
    written = format_free_form(nets);
  } catch (const InvalidMesh&) {  // numbers that have become too large
    return;
  }
  const FreeForm again = parse_free_form(written, "again.obj");  // an Error here is a crash
  require_recipe(again.curves.size() == nets.curves.size() && again.surfaces.size() == nets.surfaces.size());
}

}  // namespace
}  // namespace sublimit

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  sublimit::check_recipes(text);
  sublimit::check_field(text);
  return 0;
}
