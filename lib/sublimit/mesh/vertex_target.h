// SPDX-License-Identifier: Apache-2.0
#pragma once
// What a surface is asked to be at a vertex of a mesh. Plain data.
#include <Eigen/Core>

#include <optional>

#include "sublimit/core/types.h"

namespace sublimit {

/// Principal curvatures at a point with a normal; k > 0 where the surface bends towards the normal.
struct TargetCurvature {
  double k1 = 0, k2 = 0;       ///< in any order; per unit of length
  Eigen::Vector3d direction1;  ///< of k1: perpendicular to the normal, any length > 0
};

/// The limit of a control vertex: its place, and perhaps how the surface lies and bends there.
struct VertexTarget {
  Index vertex = 0;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  std::optional<Eigen::Vector3d> normal = {};  ///< any length > 0
  std::optional<TargetCurvature> curvature = {};
};

}  // namespace sublimit
