// SPDX-License-Identifier: Apache-2.0
#pragma once
// Joins of curves and patches decided without rounding: every double is a rational number, and so are the p/q
// of recipes.
#include <optional>
#include <span>
#include <vector>

#include "sublimit/certificates/numbers/detail/rational_number.h"
#include "sublimit/patches/joins/curve_join.h"
#include "sublimit/patches/joins/patch_seams.h"
#include "sublimit/patches/joins/surface_join.h"

namespace sublimit {

/// Returns exact numbers equal to these doubles.
/// @throws AnalysisError  a number that is not finite
BezierPiece<Rational> in_ratios(const BezierPiece<double>& piece);
BezierPatch<Rational> in_ratios(const BezierPatch<double>& patch);

/// Returns the result of curve_join with exact `orders`; distances, angles and curvatures are those of the nearest
/// doubles.
CurveJoin exact_curve_join(const BezierPiece<Rational>& left, const BezierPiece<Rational>& right);
/// Returns the result of surface_join in exact arithmetic.
SurfaceJoin exact_surface_join(const BezierPatch<Rational>& left, const BezierPatch<Rational>& right,
                               const JoinTolerance& tolerance = {});

/// Returns for every seam of kind `knot`, `period` or `sides` the orders that hold for patches of exactly these
/// doubles: sides that differ in the last bit have a gap. Nothing for other seams.
/// @param seams  found in the same patches (patch_seams)
/// @param exact  exact nets by patch, with its degrees and faces, where known; empty, or one entry per patch
std::vector<std::optional<JoinOrders>> exact_seams(std::span<const PatchColumns> patches, Coordinates coordinates,
                                                   std::span<const PatchSeam> seams,
                                                   std::span<const std::optional<SeamNet<Rational>>> exact = {});

}  // namespace sublimit
