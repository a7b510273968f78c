// SPDX-License-Identifier: Apache-2.0
#pragma once
// Curvature at places of a surface.
#include <Eigen/Core>

#include <optional>

#include "sublimit/limit/limit_stencil.h"

namespace sublimit {

/// Curvature of a surface, by its first and second derivatives.
struct Curvature {
  double gauss = 0, mean = 0;              ///< mean > 0 where the surface bends towards its normal
  double k1 = 0, k2 = 0;                   ///< principal ones, k1 >= k2
  Eigen::Vector3d direction1, direction2;  ///< of k1, k2: unit length, in the tangent plane
};

/// Returns the curvature of a sample, if it was evaluated with two derivatives, both exist there, and the first ones
/// span a plane: not at extraordinary vertices, nor where tangents degenerate.
/// @param row  of the sample
/// @throws InvalidParameter  no such row
[[nodiscard]] std::optional<Curvature> curvature(const LimitSamples& samples, Index row);

}  // namespace sublimit
