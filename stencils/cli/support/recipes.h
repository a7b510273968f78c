// SPDX-License-Identifier: Apache-2.0
#pragma once
// Recipes on the command line, which need no scheme.
#include <optional>

#include "support/source.h"
#include "sublimit/integrals/limit_integrals.h"

namespace sublimit::cli {

/// Prints the notes of recipes.
void tell_notes(const std::vector<Recipe>& recipes);

/// Part of recipes that a job uses: curves; linear surfaces; or, if there are none, surfaces that are not linear; or
/// both.
enum class Sampled { curves, surfaces, normal_triangles, all_surfaces };

/// Prints which recipes a job leaves out, and why.
void tell_left_out(const Source& source, Sampled taken);

/// Prints information on recipes, for `info`.
/// @param integrals  over the surfaces, for JSON
/// @throws Error  as load_normal_surface
void print_recipes(const Source& source, bool json, const std::optional<LimitIntegrals>& integrals);

}  // namespace sublimit::cli
