// SPDX-License-Identifier: Apache-2.0
#pragma once
// Targets at vertices as linear conditions on control points, and how far control points are from meeting them.
#include "sublimit/fit/targets.h"
#include "sublimit/fit/vertex_limits.h"

namespace sublimit {

/// C x = d. Points alone: a row per target over the points, a column of d per coordinate. With normals: three rows per
/// target and two per side over all coordinates of all points, interleaved (x, y, z of the first point, ...), and one
/// column.
struct VertexConditions {
  SparseMatrix C;
  Points d;
  bool coupled = false;              ///< with normals
  std::vector<Index> without_plane;  ///< targets whose normal is left out: no tangent plane, or only holes
};
/// @param limits   of the targets' vertices, in their order
/// @param targets  normals of unit length
VertexConditions vertex_conditions(const VertexLimits& limits, const std::vector<VertexTarget>& targets);

struct VertexErrors {
  Eigen::VectorXd position;  ///< distance, by target
  Eigen::VectorXd
      normal;  ///< radians, by target, the largest of its sides; NaN where it was left out or never asked for
};
VertexErrors vertex_errors(const VertexLimits& limits, const std::vector<VertexTarget>& targets, const Points& points);

}  // namespace sublimit
