// SPDX-License-Identifier: Apache-2.0
#pragma once
// How far two surfaces are from a smooth join along an edge that they have in common, in numbers: the gap, the angle of
// the normals, the jump of the normal curvature across the edge, each where it is greatest.
#include <array>
#include <functional>
#include <optional>
#include <span>

#include "sublimit/limit/limit_map.h"
#include "sublimit/patches/joins/join_orders.h"

namespace sublimit {

/// A surface along an edge.
struct EdgeSide {
  /// Points at 0 <= s <= 1 with derivatives up to order 2 and normals.
  std::function<LimitSamples(std::span<const double> s)> evaluate;
  bool along_v = true;  ///< the edge is a line of constant u, else of constant v
  double sign = 1;      ///< +-1: seen from one side of the join, the normal is that times du x dv, on both surfaces
};

struct EdgeMaximum {
  double value = 0;
  double s = 0;                      ///< where on the edge
  std::array<double, 3> point = {};  ///< of the left surface
};

struct EdgeDeviation {
  EdgeMaximum gap{};
  std::optional<EdgeMaximum> angle{};           ///< of the normals, radians; nothing if a surface has none
  std::optional<EdgeMaximum> curvature_jump{};  ///< 1/length
  double greatest_curvature = 0;                ///< of either surface across the edge
  bool has_pole = false;                        ///< somewhere a surface has no point
};

/// The greatest deviations on an edge: at `samples` places, evenly spaced, and around the greatest of them by golden
/// sections between their neighbours.
///
/// The curvature is that of normal sections perpendicular to the edge, with respect to the normals of the join: if they
/// agree, it decides on G^2 (Pegna, Wolter 1992). Where the area |du x dv| is less than 1e-6 of its greatest on the
/// edge normals count only if they are limits (LimitSamples), where it is less than 1e-3, curvatures do not: towards a
/// pole they are rounding.
/// @param samples  2 at least
EdgeDeviation measured_deviation(const EdgeSide& left, const EdgeSide& right, int samples);

/// Returns the orders of a join from deviations of derivatives.
/// @param c     of C^k, as derivatives say; -1 for a gap
/// @param size  of the two pieces
JoinOrders measured_orders(const EdgeDeviation& deviation, int c, bool is_same, double size,
                           const JoinTolerance& tolerance);

}  // namespace sublimit
