// SPDX-License-Identifier: Apache-2.0
#pragma once
// The report on how curves and surfaces of recipes join: on their exact nets as free-form shapes, and on the
// joins that recipes of kind `curve_join` and `surface_join` require, decided without rounding.
#include "sublimit/report/free_form/free_form_report.h"
#include "sublimit/stencils/recipes/detail/recipe.h"

namespace sublimit {

/// Returns the report on the shapes that `net_file` would write, and on joins, whose pieces come last. Recipes
/// without a net are left out, with a warning.
/// @param name  name of the file, for messages
/// @throws UnsupportedTopology  no recipe has a net or is a join; the message has the reason
/// @throws FormatError          degrees or numbers for which joins cannot be decided; the message names the
///                              recipe
FreeFormReport recipe_report(const std::vector<Recipe>& recipes, const std::string& name,
                             const FreeFormReportOptions& options = {});

}  // namespace sublimit
