// SPDX-License-Identifier: Apache-2.0
#pragma once
// Exact nets of recipes without rounding: constructions of rational numbers (thirds of tangents, blossoms, boolean
// sums) once more in ratios, from the numbers that the recipe has: its fractions, and exactly its doubles.
#include <optional>
#include <vector>

#include "sublimit/certificates/numbers/detail/rational_number.h"
#include "sublimit/patches/joins/seam_strips.h"
#include "sublimit/stencils/recipes/detail/recipe.h"

namespace sublimit {

/// The Bezier pieces of a recipe's curve in space, one for each span of its knots.
/// @return  nothing of kinds whose control points are no ratios of their numbers, or solve large systems
std::optional<std::vector<BezierPiece<Rational>>> exact_pieces(const Recipe& recipe);

/// The net of a recipe's surface.
/// @return  nothing of kinds whose control points are no ratios of their numbers, or solve large systems
std::optional<SeamNet<Rational>> exact_net(const Recipe& recipe);

}  // namespace sublimit
