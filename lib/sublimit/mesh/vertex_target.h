// SPDX-License-Identifier: Apache-2.0
#pragma once
// Targets at vertices: positions, normals and curvatures that the limit should have at control vertices.
//
//   const VertexTarget target = {.vertex = 0, .position = {0, 0, 1}, .normal = Eigen::Vector3d(0, 0, 1)};
//   const Fit result = fit(mesh, "loop", {target});  // sublimit.h
#include <Eigen/Core>

#include <optional>

#include "sublimit/core/types.h"

namespace sublimit {

/// Principal curvatures at a point with a normal; k > 0 if the surface bends towards the normal. Plain data.
struct TargetCurvature {
  double k1 = 0, k2 = 0;  ///< principal curvatures in any order, per unit of length
  /// Principal direction of k1: perpendicular to the normal, any length > 0.
  Eigen::Vector3d direction1 = Eigen::Vector3d::Zero();
};

/// Target for the limit of a control vertex: its position, and optionally normal and curvature. Plain data.
struct VertexTarget {
  Index vertex = 0;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  std::optional<Eigen::Vector3d> normal = {};     ///< direction of the normal, any length > 0
  std::optional<TargetCurvature> curvature = {};  ///< needs a normal; for `curvature_mesh` (geometric schemes)
};

}  // namespace sublimit
