// SPDX-License-Identifier: Apache-2.0
#include "sublimit/stencils/recipes/detail/recipe_sources.h"

#include <algorithm>
#include <utility>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/error.h"

namespace sublimit {
namespace {

Coordinates shared_coordinates(const std::vector<Coordinates>& all) {
  return std::ranges::find(all, Coordinates::homogeneous) == all.end() ? Coordinates::plain : Coordinates::homogeneous;
}

std::string count_of_recipes(const std::vector<Recipe>& recipes) {
  return recipes.size() == 1 ? "one recipe" : format_number(recipes.size()) + " recipes";
}

}  // namespace

RecipePatches recipe_patches(const std::vector<Recipe>& recipes, const std::string& name) {
  std::vector<const Recipe*> used;
  std::vector<std::shared_ptr<const Patch>> patches;
  std::vector<Coordinates> coordinates;
  for (const Recipe& recipe : recipes)
    if (const RecipeSurface* const surface = recipe.surface()) {
      used.push_back(&recipe);
      patches.push_back(surface->patch);
      coordinates.push_back(surface->coordinates);
    }
  if (patches.empty()) {
    const bool normals = std::ranges::any_of(recipes, [](const Recipe& recipe) { return recipe.normal_triangles(); });
    throw UnsupportedTopology(
        name + ": " + count_of_recipes(recipes) + ", none of a surface" +
        (normals ? " that is linear in its points: nielson and piper are not, and have no matrix" : ""));
  }
  const Coordinates common = shared_coordinates(coordinates);
  try {
    PatchSet set(patches, common);
    Points columns(set.num_points(), common == Coordinates::homogeneous ? 4 : 3);
    Eigen::Index at = 0;
    for (const Recipe* const recipe : used) {
      const RecipeSurface& surface = *recipe->surface();
      auto own = columns.middleRows(at, surface.columns.rows());
      own.leftCols(surface.columns.cols()) = surface.columns;
      if (surface.columns.cols() < columns.cols()) own.rightCols(1).setOnes();
      at += surface.columns.rows();
    }
    return {std::move(set), std::move(columns), std::move(used)};
  } catch (const UnsupportedTopology& error) {
    throw UnsupportedTopology(name + ": " + error.what());
  }
}

RecipeCurves recipe_curves(const std::vector<Recipe>& recipes, const std::string& name) {
  std::vector<const Recipe*> used;
  std::vector<std::shared_ptr<const LinearCurve>> curves;
  std::vector<Coordinates> coordinates;
  Eigen::Index dimension = 0;
  const auto dimension_of = [](const RecipeCurve& curve) {
    return curve.columns.cols() - (curve.coordinates == Coordinates::homogeneous ? 1 : 0);
  };
  for (const Recipe& recipe : recipes)
    if (const RecipeCurve* const curve = recipe.curve()) {
      used.push_back(&recipe);
      curves.push_back(curve->curve);
      coordinates.push_back(curve->coordinates);
      dimension = std::max(dimension, dimension_of(*curve));
    }
  if (curves.empty()) throw UnsupportedTopology(name + ": " + count_of_recipes(recipes) + ", none of a curve");
  const Coordinates common = shared_coordinates(coordinates);
  CurveSet set(std::move(curves));
  Points columns = Points::Zero(set.num_points(), dimension + (common == Coordinates::homogeneous ? 1 : 0));
  Eigen::Index at = 0;
  for (const Recipe* const recipe : used) {
    const RecipeCurve& curve = *recipe->curve();
    auto own = columns.middleRows(at, curve.columns.rows());
    own.leftCols(dimension_of(curve)) = curve.columns.leftCols(dimension_of(curve));
    if (curve.coordinates == Coordinates::homogeneous)
      own.rightCols(1) = curve.columns.rightCols(1);
    else if (common == Coordinates::homogeneous)
      own.rightCols(1).setOnes();
    at += curve.columns.rows();
  }
  return {std::move(set), std::move(columns), common, std::move(used)};
}

}  // namespace sublimit
