// SPDX-License-Identifier: Apache-2.0
#pragma once
// Limit positions and normals of all vertices of a level, as matrices over its points and as points.
#include <vector>

#include "sublimit/limit/detail/limit_cache.h"
#include "sublimit/scheme/refine.h"
#include "sublimit/source/limit_status.h"

namespace sublimit {

/// Rows over the points of one level. A vertex has one side, unless sharp edges or several fans separate its
/// faces.
struct [[nodiscard]] LimitMatrices {
  SparseMatrix position;            ///< L, #V x #V: x_inf = L * x
  SparseMatrix tangent1, tangent2;  ///< #sides x #V
  /// Rows of the next modes, for sides with degenerate tangents: side s has rows second_order_begin[s] to
  /// second_order_begin[s + 1] - 1.
  SparseMatrix second_order;
  std::vector<Index> second_order_begin;
  std::vector<Index> side_vertex;   ///< vertex of each side; ascending
  std::vector<Index> corner_side;   ///< side of each half-edge (corner of a face)
  std::vector<LimitStatus> status;  ///< of each side, for generic points
};

/// Returns the limit rows of a level.
/// @throws NoLimit  names the first vertex without a limit
LimitMatrices limit_matrices(const Level& level, LimitCache& cache);
/// Returns the limit rows of the last level. Errors name the vertex by its position on level 0.
LimitMatrices limit_matrices(const std::vector<Level>& levels, LimitCache& cache);

/// Limit points and normals.
struct [[nodiscard]] LimitPoints {
  Points position;                  ///< #V x 3
  Points normal;                    ///< #sides x 3, unit length, zero where undefined
  std::vector<LimitStatus> status;  ///< status of each side for these points
};

/// Returns limit positions and normals for given points. Normals follow the winding of the faces; where the tangents
/// degenerate, the next modes decide, if they span a plane.
/// @param topology  topology of the level
/// @param points    points of the level, #V x 3
/// @throws InvalidParameter  points of another shape
LimitPoints limit_points(const LimitMatrices& limit, const Topology& topology, const Points& points);

}  // namespace sublimit
