// SPDX-License-Identifier: Apache-2.0
#pragma once
// All surfaces or all curves of a file as one linear source with its control points.
#include "sublimit/patches/curve_set.h"
#include "sublimit/patches/patch_set.h"
#include "sublimit/stencils/recipes/detail/recipe.h"

namespace sublimit {

struct [[nodiscard]] RecipePatches {
  PatchSet patches;
  Points columns;                     ///< x 3, or x 4, homogeneous, if one of them is rational
  std::vector<const Recipe*> recipe;  ///< recipe of each patch
};
/// Returns all surfaces of recipes as one source.
/// @param recipes  must outlive the result
/// @param name     name of the file, for messages
/// @throws UnsupportedTopology  no surfaces; triangles beside squares
RecipePatches recipe_patches(const std::vector<Recipe>& recipes, const std::string& name);
RecipePatches recipe_patches(const std::vector<Recipe>&&, const std::string&) = delete;

struct [[nodiscard]] RecipeCurves {
  CurveSet curves;
  Points columns;  ///< columns of the largest dimension; 0 for curves of a smaller one
  Coordinates coordinates = Coordinates::plain;
  std::vector<const Recipe*> recipe;  ///< recipe of each curve
};
/// Returns all curves of recipes as one source.
/// @param recipes  must outlive the result
/// @throws UnsupportedTopology  no curves
RecipeCurves recipe_curves(const std::vector<Recipe>& recipes, const std::string& name);
RecipeCurves recipe_curves(const std::vector<Recipe>&&, const std::string&) = delete;

}  // namespace sublimit
