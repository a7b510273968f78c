// SPDX-License-Identifier: Apache-2.0
#pragma once
// Exact nets as free-form curves and surfaces of OBJ files: `bezier` for a single piece, else `bspline`, with
// `rat` if they are rational. Closed ones repeat their first points, with knots that continue beyond the ends.
#include "sublimit/io/free_form.h"
#include "sublimit/stencils/recipes/detail/recipe.h"

namespace sublimit {

/// Recipes with an exact net, and those without.
struct [[nodiscard]] RecipeNets {
  FreeForm shapes;
  std::vector<const Recipe*> surface, curve;  ///< recipe of each element
  struct LeftOut {
    const Recipe* recipe = nullptr;
    std::string why;
  };
  std::vector<LeftOut> left_out;
};
/// Returns the nets of recipes.
/// @param recipes  must outlive the result
RecipeNets recipe_nets(const std::vector<Recipe>& recipes);
RecipeNets recipe_nets(const std::vector<Recipe>&&) = delete;

/// Returns the nets of recipes as free-form shapes.
/// @throws UnsupportedTopology  a recipe without an exact net, or with one that OBJ cannot hold; the message
///                              has which, and why
FreeForm net_file(const std::vector<Recipe>& recipes);

}  // namespace sublimit
