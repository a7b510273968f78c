// SPDX-License-Identifier: Apache-2.0
#pragma once
// Limit rows of control vertices over the points of any level. Where a level has no child vertex of a vertex (dual
// schemes) its limit is that of the face that it becomes.
#include <span>
#include <vector>

#include "sublimit/limit/detail/limit_cache.h"
#include "sublimit/source/limit_status.h"
#include "sublimit/neighborhood/centre.h"
#include "sublimit/scheme/refine.h"

namespace sublimit {

/// Rows over the points of the last level.
struct VertexLimits {
  /// One row per vertex asked for; under dual schemes one per sheet of faces at it, which have limits of their own.
  SparseMatrix position;
  std::vector<Index> position_vertex;  ///< number of the vertex in the list asked for, of each row; ascending
  SparseMatrix tangent1, tangent2;     ///< one row per side of these vertices; tangent1 x tangent2 is along the normal
  std::vector<Index> side_vertex;      ///< number of the vertex in the list asked for, of each side
  std::vector<LimitStatus> status;     ///< of each side, for generic points
};

/// Returns the place on the last level of a place of the first one.
Centre descendant(Centre centre, std::span<const Level> levels);

/// @param levels    0 to any
/// @param vertices  of level 0, none isolated
/// @throws AnalysisError  a vertex without a limit
VertexLimits vertex_limits(std::span<const Level> levels, LimitCache& cache, std::span<const Index> vertices);

}  // namespace sublimit
