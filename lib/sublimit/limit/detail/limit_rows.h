// SPDX-License-Identifier: Apache-2.0
#pragma once
// Limit rows of any places of a level, of any scheme: the one way to the limits of vertices, faces and borders. Where
// the neighbourhood is a known type its masks are; elsewhere the faces around it are refined, by the scheme's own
// matrices, until it is: L_k = L_{k+1} S_k. Places that never are have a position if their neighbourhood comes to
// repeat itself.
#include "sublimit/core/detail/sparse_rows.h"
#include "sublimit/limit/detail/limit_cache.h"
#include "sublimit/limit/no_limit.h"
#include "sublimit/limit/limit_status.h"
#include "sublimit/scheme/refine.h"

namespace sublimit {

/// Rows over the vertices of the level.
struct LimitRows {
  using Row = SparseRows::Row;
  SparseRows rows;  ///< the position's, alone where no tangents are known, or with two of tangents and of second order
  LimitMasks::Plane plane = LimitMasks::Plane::yes;
  Rule rule = Rule::smooth;  ///< once all finite sharpness is gone
  Index faces = 0;           ///< around the place on its side, once it is alone, or repeats itself
  /// Status of the place on this side, for generic control points; holes are not considered.
  LimitStatus status = LimitStatus::regular;

  Row position() const { return rows[0]; }
  bool has_tangents() const { return rows.size() > 1; }
  Row tangent1() const { return has_tangents() ? rows[1] : Row(); }
  Row tangent2() const { return has_tangents() ? rows[2] : Row(); }
  size_t num_second_order() const { return has_tangents() ? rows.size() - 3 : 0; }
  Row second_order(size_t k) const { return rows[3 + k]; }
};

/// @param centres  of vertices those of one side, as `vertex_sides` has them
/// @throws NoLimit  naming the first place that has none
std::vector<LimitRows> limit_rows(const Level& level, LimitCache& cache, std::span<const Centre> centres);
LimitRows limit_rows(const Level& level, LimitCache& cache, const Centre& centre);

}  // namespace sublimit
