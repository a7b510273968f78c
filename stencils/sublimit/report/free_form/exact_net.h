// SPDX-License-Identifier: Apache-2.0
#pragma once
// Nets of recipes without rounding. Constructions that need rational operations only (thirds of tangents,
// blossoms, boolean sums) are repeated in ratios, from the fractions and the exact doubles of the recipe.
#include <optional>
#include <vector>

#include "sublimit/certificates/numbers/detail/rational_number.h"
#include "sublimit/patches/joins/seam_strips.h"
#include "sublimit/stencils/recipes/detail/recipe.h"

namespace sublimit {

/// Returns the Bezier pieces of a recipe's curve in space, one for each span of its knots.
/// @return  absent for kinds whose control points are not rational functions of their numbers, or solve large
///          systems
std::optional<std::vector<BezierPiece<Rational>>> exact_pieces(const Recipe& recipe);

/// Returns the net of a recipe's surface; absent as for `exact_pieces`.
std::optional<SeamNet<Rational>> exact_net(const Recipe& recipe);

}  // namespace sublimit
