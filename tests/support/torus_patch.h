// SPDX-License-Identifier: Apache-2.0
#pragma once
// A piece of a torus, sphere, cylinder or plane as a rational biquadratic patch: a tensor product of conics, whose
// weights, cosines of half the angles, make arcs of circles exact. What a new point of the scheme of torus pieces lies
// in the middle of, before the patch is bent.
#include <array>

#include "sublimit/geometric/torus_piece.h"

namespace sublimit::testing {

struct RationalPatch {
  /// Three along the tube, for each of three around: number 3 j + i.
  std::array<Eigen::Vector3d, 9> points;
  std::array<double, 9> weights;

  /// s along the tube and t around, in [0, 1].
  Eigen::Vector3d at(double s, double t) const;
};

/// The patch whose middle is `centre`, by the lengths half_u along the tube and half_v around to each side.
/// @pre  it spans less than half of either circle: half_u |k1| < pi/2, half_v |kappa| < pi/2
/// @param centre  w is ignored
RationalPatch torus_patch(const TorusPiece& piece, const TorusPiece::Coordinates& centre, double half_u, double half_v);

}  // namespace sublimit::testing
