// SPDX-License-Identifier: Apache-2.0
#pragma once
// Limit rows of any places of a level, of any scheme: the one way to the limits of vertices, faces and borders. Where
// the neighbourhood is a known type its masks are; elsewhere the faces around it are refined, by the scheme's own
// matrices, until it is: L_k = L_{k+1} S_k. Places that never are have a position if their neighbourhood comes to repeat
// itself.
#include "sublimit/limit/limit_types.h"
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
  Rule rule = Rule::smooth;  ///< once all finite sharpness is gone
  Index faces = 0;           ///< around the place on its side, once it is alone, or repeats itself
  /// What there is, seen from this side, for generic points; holes are not known here.
  LimitStatus status = LimitStatus::regular;
};

/// @param centres  of vertices those of one side, as `vertex_sides` has them
/// @throws NoLimit  naming the first place that has none
std::vector<LimitRows> limit_rows(const Level& level, LimitTypes& cache, const std::vector<Centre>& centres);

/// Rows as a matrix.
SparseMatrix matrix_of(std::span<const LimitRows::Row* const> rows, Index columns);

}  // namespace sublimit
