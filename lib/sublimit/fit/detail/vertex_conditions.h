// SPDX-License-Identifier: Apache-2.0
#pragma once
// Targets at vertices as linear conditions on control points, and how far control points are from meeting them.
#include <map>

#include "sublimit/fit/detail/vertex_limits.h"
#include "sublimit/fit/targets.h"

namespace sublimit {

/// Tangents that a side is to have, as columns: tangent1, tangent2. Stronger than a normal, whose rows hold for the
/// opposite one too.
using TangentFrame = Eigen::Matrix<double, 3, 2>;

/// C x = d. Points alone: a row per target over the points, a column of d per coordinate. With normals: three rows per
/// target and two per side (six with a frame) over all coordinates of all points, interleaved (x, y, z of the first
/// point, ...), and one column.
struct VertexConditions {
  SparseMatrix C;
  Points d;
  bool coupled = false;              ///< with normals
  std::vector<Index> without_plane;  ///< targets whose normal is left out: no tangent plane, or only holes
};
/// @param limits   of the targets' vertices, in their order
/// @param targets  normals of unit length
/// @param frames   by number of the side: conditions in place of its normal's
VertexConditions vertex_conditions(const VertexLimits& limits, const std::vector<VertexTarget>& targets,
                                   const std::map<Index, TangentFrame>& frames = {});

/// Vertices with a side whose normal is more than a right angle off: all their sides, with the frames that `guess` has
/// there, turned to the target's normal together and laid into its plane; where these do not lie to one side, those
/// sides alone.
std::map<Index, TangentFrame> turned_frames(const VertexLimits& limits, const std::vector<VertexTarget>& targets,
                                            const Points& points, const Points& guess);

struct VertexErrors {
  Eigen::VectorXd position;  ///< distance, by target
  Eigen::VectorXd normal;    ///< radians, by target, the largest of its sides; NaN where there is none
};
VertexErrors vertex_errors(const VertexLimits& limits, const std::vector<VertexTarget>& targets, const Points& points);

}  // namespace sublimit
