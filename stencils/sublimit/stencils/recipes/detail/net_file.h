// SPDX-License-Identifier: Apache-2.0
#pragma once
// Exact nets as free-form curves and surfaces of OBJ files: `bezier` where there is one piece, else `bspline`, `rat`
// where they are rational. Closed ones are written with their first points again and knots that go on beyond the ends.
#include "sublimit/io/free_form.h"
#include "sublimit/stencils/recipes/detail/recipe.h"

namespace sublimit {

/// The recipes that have such a net, and those that have none.
struct [[nodiscard]] RecipeNets {
  FreeForm shapes;
  std::vector<const Recipe*> surface, curve;  ///< recipe of each element
  struct LeftOut {
    const Recipe* recipe = nullptr;
    std::string why;
  };
  std::vector<LeftOut> left_out;
};
/// @param recipes  have to stay
RecipeNets recipe_nets(const std::vector<Recipe>& recipes);
RecipeNets recipe_nets(const std::vector<Recipe>&&) = delete;

/// @throws UnsupportedTopology  a recipe without an exact net, or with one that OBJ cannot hold: which and why
FreeForm net_file(const std::vector<Recipe>& recipes);

}  // namespace sublimit
