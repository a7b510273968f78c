// SPDX-License-Identifier: Apache-2.0
#pragma once
// Limit rows of any places of a level. Where a place is alone among regular points its masks are known by its type; elsewhere the
// faces around it are refined, by the scheme's own matrices, until it is: L_k = L_{k+1} S_k. Places that never are have a position
// if their neighbourhood comes to repeat itself.
#include "sublimit/limit/limit_masks.h"
#include "sublimit/limit/limit_status.h"
#include "sublimit/limit/no_limit.h"
#include "sublimit/scheme/refine.h"

namespace sublimit {

/// Rows over the vertices of the level.
struct LimitRows {
  using Row = std::vector<std::pair<Index, double>>;  // columns ascending
  Row position, tangent1, tangent2;
  std::vector<Row> second_order;
  LimitMasks::Plane plane = LimitMasks::Plane::yes;
  LocalType type;  ///< once it is alone, or repeats itself
};

/// What there is at the place, seen from its side, for generic points; holes are not known here. Limits of vertices and
/// samples at corners of faces are told by these two alone.
LimitStatus generic_status(const LimitRows& rows, const Scheme<double>& scheme);
LimitStatus generic_status(const LimitMasks& masks, const LimitMasks::Side& side, const Scheme<double>& scheme);

/// @throws NoLimit  naming the first place that has none
std::vector<LimitRows> limit_rows(const Level& level, LimitMaskCache& cache, const std::vector<Centre>& centres);

}  // namespace sublimit
