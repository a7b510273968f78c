// SPDX-License-Identifier: Apache-2.0
#pragma once
// Recipes on the command line: they take no scheme.
#include "common.h"
#include "sublimit/recipes/recipe.h"

namespace sublimit::cli {

/// Whether the file is to be taken as recipes: a .json, and no scheme is named.
bool is_recipe_job(const Common& common);

/// The recipes of the file; their notes are printed.
std::vector<Recipe> load_recipes(const Common& common);

/// What a job takes of recipes: curves, surfaces that are linear, or, where there are none, surfaces that are not.
enum class Sampled { curves, surfaces, normal_triangles };

/// Says which recipes a job leaves out, and why.
void tell_left_out(const Common& common, const std::vector<Recipe>& recipes, Sampled taken);

/// What `info` tells of them.
/// @throws Error  as load_normal_surface
void print_recipes(const Common& common, const std::vector<Recipe>& recipes, bool json);

}  // namespace sublimit::cli
