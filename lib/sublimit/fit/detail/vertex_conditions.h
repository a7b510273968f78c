// SPDX-License-Identifier: Apache-2.0
#pragma once
// Targets at vertices as linear conditions on control points, and their residuals.
#include <map>

#include "sublimit/fit/detail/vertex_limits.h"
#include "sublimit/fit/targets.h"

namespace sublimit {

/// Prescribed tangents of a side, as columns: tangent1, tangent2. Stronger than a normal, whose conditions also
/// hold for the opposite normal.
using TangentFrame = Eigen::Matrix<double, 3, 2>;

/// The conditions C x = d. Without normals: a row per target over the points, and a column of d per coordinate.
/// With normals: three rows per target and two per side (six with a frame) over all coordinates of all points,
/// interleaved (x, y, z of the first point, ...), and one column.
struct VertexConditions {
  SparseMatrix C;
  Points d;
  bool coupled = false;              ///< true with normals
  std::vector<Index> without_plane;  ///< targets whose normal is ignored: no tangent plane, or only holes
};
/// Returns the conditions of targets.
/// @param limits   limits of the targets' vertices, in their order
/// @param targets  targets with unit normals
/// @param frames   by number of a side: tangents to prescribe instead of its normal
VertexConditions vertex_conditions(const VertexLimits& limits, const std::vector<VertexTarget>& targets,
                                   const std::map<Index, TangentFrame>& frames = {});

/// Returns frames for vertices that have a side whose normal is off by more than a right angle. All sides of
/// the vertex get the frames of `guess`, rotated together to the normal of the target and projected into its
/// plane; if these frames are not all on one side, only the wrong sides get them.
std::map<Index, TangentFrame> turned_frames(const VertexLimits& limits, const std::vector<VertexTarget>& targets,
                                            const Points& points, const Points& guess);

/// Deviations from targets.
struct VertexErrors {
  Eigen::VectorXd position;  ///< distance by target
  Eigen::VectorXd normal;    ///< radians by target, largest of its sides; NaN without a normal
};
/// Returns the deviations of given control points.
VertexErrors vertex_errors(const VertexLimits& limits, const std::vector<VertexTarget>& targets, const Points& points);

}  // namespace sublimit
