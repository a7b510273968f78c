// SPDX-License-Identifier: Apache-2.0
#pragma once
// Recipes on the command line, which need no scheme.
#include "support/common.h"
#include "sublimit/stencils/recipes/detail/recipe.h"

namespace sublimit::cli {

/// Returns true if the file is to be read as recipes: a .json, and no scheme is given.
bool is_recipe_job(const Common& common);

/// Loads the recipes of a file, and prints their notes.
std::vector<Recipe> load_recipes(const Common& common);

/// Part of recipes that a job uses: curves; linear surfaces; or, if there are none, surfaces that are not linear.
enum class Sampled { curves, surfaces, normal_triangles };

/// Prints which recipes a job leaves out, and why.
void tell_left_out(const Common& common, const std::vector<Recipe>& recipes, Sampled taken);

/// Prints information on recipes, for `info`.
/// @throws Error  as load_normal_surface
void print_recipes(const Common& common, const std::vector<Recipe>& recipes, bool json);

}  // namespace sublimit::cli
