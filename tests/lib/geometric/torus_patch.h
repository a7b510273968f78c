// SPDX-License-Identifier: Apache-2.0
#pragma once
// A piece of a torus, sphere, cylinder or plane as a rational biquadratic patch: a tensor product of conics, in
// which weights (cosines of half the angles) make arcs of circles exact. A new point of the scheme of torus
// pieces is in the middle of such a patch, before the patch is bent.
#include <array>

#include "sublimit/geometric/torus_piece.h"

namespace sublimit::testing {

struct RationalPatch {
  /// Control points: i = 0, 1, 2 along the tube, j = 0, 1, 2 around; number 3 j + i.
  std::array<Eigen::Vector3d, 9> points;
  std::array<double, 9> weights;

  /// Returns the point at s along the tube and t around, both in [0, 1].
  Eigen::Vector3d at(double s, double t) const;
};

/// Returns the patch with the middle `centre` that extends by half_u along the tube and by half_v around to
/// each side.
/// @pre  it spans less than half of either circle: half_u |k1| < pi/2, half_v |kappa| < pi/2
/// @param centre  coordinates of the middle; w is ignored
RationalPatch torus_patch(const TorusPiece& piece, const TorusPiece::Coordinates& centre, double half_u, double half_v);

}  // namespace sublimit::testing
