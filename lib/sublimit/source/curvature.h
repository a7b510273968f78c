// SPDX-License-Identifier: Apache-2.0
#pragma once
// Curvature of surfaces, from the derivatives that `evaluate` returns.
//
//   const LimitSamples samples = surface.evaluate({{.face = 0, .u = 0.5, .v = 0.25}}, 2);
//   if (const std::optional<Curvature> bend = curvature(samples, 0)) std::cout << bend->gauss << "\n";
#include <Eigen/Core>

#include <optional>

#include "sublimit/source/limit_stencil.h"

namespace sublimit {

/// Curvature of a surface at a point, per unit of length. Plain data.
struct Curvature {
  double gauss = 0, mean = 0;              ///< Gaussian and mean curvature; mean > 0: bends towards the normal
  double k1 = 0, k2 = 0;                   ///< principal curvatures, k1 >= k2
  Eigen::Vector3d direction1, direction2;  ///< principal directions of k1, k2: unit length, in the tangent plane
};

/// Returns the curvature at a row of evaluated places, if it was evaluated with two derivatives, both exist there, and
/// the first ones span a plane; nothing at extraordinary vertices and where tangents degenerate.
/// @throws InvalidParameter  a row that does not exist
[[nodiscard]] std::optional<Curvature> curvature(const LimitSamples& samples, Index row);

}  // namespace sublimit
