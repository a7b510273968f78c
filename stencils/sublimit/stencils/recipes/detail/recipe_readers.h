// SPDX-License-Identifier: Apache-2.0
#pragma once
// Readers of the kinds of recipes, by families: each takes the fields of an object and fills the recipe's shape.
// Callers add the recipe's name to the errors of constructions.
#include <span>

#include "sublimit/stencils/recipes/detail/recipe.h"
#include "sublimit/stencils/recipes/detail/recipe_object.h"

namespace sublimit {

struct RecipeKind {
  const char* name;
  void (*read)(RecipeObject& object, Recipe& recipe);
};
std::span<const RecipeKind> curve_kinds();
std::span<const RecipeKind> grid_kinds();          ///< control nets, points in grids and triangles
std::span<const RecipeKind> construction_kinds();  ///< surfaces from curves
std::span<const RecipeKind> blended_kinds();       ///< Hermite, Coons, Gregory, Gordon
std::span<const RecipeKind> data_kinds();          ///< kinds that are given as data

/// Control points as a recipe gives them: `points` or `homogeneous`.
struct GivenColumns {
  Points columns;
  Coordinates coordinates = Coordinates::plain;
};
/// Reads the points of a curve: in any dimension, or in space, where points of two coordinates have z = 0.
GivenColumns read_columns(RecipeObject& object, bool in_any_dimension, std::vector<std::string>& notes);

/// Reads knots: all knots of an open curve, or the break points of a closed one. Their number must fit the
/// control points.
/// @param points  number of control points
Knots<double> read_knots(RecipeObject& object, const std::string& field, int degree, Eigen::Index points, bool closed,
                         std::vector<std::string>& notes);

/// Reads a curve in a field: {degree, knots, points} or {degree, knots, homogeneous}.
CurveNet read_inner_curve(RecipeObject& object, const std::string& field, std::vector<std::string>& notes);

void set_surface(Recipe& recipe, SplineNet net);
void set_curve(Recipe& recipe, CurveNet net);

}  // namespace sublimit
