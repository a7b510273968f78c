// SPDX-License-Identifier: Apache-2.0
#pragma once
// Limit rows of control vertices over the points of any level. In dual schemes, where a vertex becomes a face,
// its limit is that of the face.
#include <span>
#include <vector>

#include "sublimit/limit/detail/limit_cache.h"
#include "sublimit/neighborhood/centre.h"
#include "sublimit/scheme/refine.h"
#include "sublimit/source/limit_status.h"

namespace sublimit {

/// Rows over the points of the last level.
struct VertexLimits {
  /// One row per requested vertex; in dual schemes one per sheet of faces at it, since sheets have separate
  /// limits.
  SparseMatrix position;
  std::vector<Index> position_vertex;  ///< by row: index of the vertex in the requested list, ascending
  SparseMatrix tangent1, tangent2;     ///< one row per side of these vertices; tangent1 x tangent2 is along the normal
  std::vector<Index> side_vertex;      ///< by side: index of the vertex in the requested list
  std::vector<LimitStatus> status;     ///< by side: status for generic points
};

/// Returns the place on the last level of a centre of the first one.
Centre descendant(Centre centre, std::span<const Level> levels);

/// Returns limit rows of vertices of level 0 over the points of the last level.
/// @param levels    levels 0 to any
/// @param vertices  vertices of level 0, none isolated
/// @throws AnalysisError  a vertex without a limit
VertexLimits vertex_limits(std::span<const Level> levels, LimitCache& cache, std::span<const Index> vertices);

}  // namespace sublimit
