// SPDX-License-Identifier: Apache-2.0
#pragma once
// Limit rows of vertices, faces and borders of a level, for any scheme. If the neighbourhood of the place has a
// type with limit masks, these are used. Else the faces around it are refined by the scheme's own matrices
// until it has: L_k = L_{k+1} S_k. Places that never reach such a type have only a position, if their
// neighbourhood becomes stationary.
#include "sublimit/core/detail/sparse_rows.h"
#include "sublimit/limit/detail/limit_cache.h"
#include "sublimit/scheme/refine.h"
#include "sublimit/source/limit_status.h"

namespace sublimit {

/// Limit rows of one place, over the vertices of the level.
struct LimitRows {
  using Row = SparseRows::Row;
  SparseRows rows;  ///< position; then, if tangents are known, both tangents and the rows of second order
  LimitMasks::Plane plane = LimitMasks::Plane::yes;
  Rule rule = Rule::smooth;  ///< rule of the place after finite sharpness has decayed
  Index faces = 0;           ///< faces around the place on its side, once it is isolated or stationary
  /// Status of the place on this side, for generic control points; holes are not considered.
  LimitStatus status = LimitStatus::regular;

  Row position() const { return rows[0]; }
  bool has_tangents() const { return rows.size() > 1; }
  Row tangent1() const { return has_tangents() ? rows[1] : Row(); }
  Row tangent2() const { return has_tangents() ? rows[2] : Row(); }
  size_t num_second_order() const { return has_tangents() ? rows.size() - 3 : 0; }
  Row second_order(size_t k) const { return rows[3 + k]; }
};

/// Returns the limit rows of places of a level.
/// @param centres  the places; those of vertices are for one side each, as `vertex_sides` makes them
/// @throws NoLimit  names the first place without a limit
std::vector<LimitRows> limit_rows(const Level& level, LimitCache& cache, std::span<const Centre> centres);
LimitRows limit_rows(const Level& level, LimitCache& cache, const Centre& centre);

}  // namespace sublimit
