// SPDX-License-Identifier: Apache-2.0
#pragma once
// Measured deviations of two surfaces from a smooth join along a common edge: the largest gap, angle between
// normals, and jump of the normal curvature across the edge.
#include <array>
#include <functional>
#include <optional>
#include <span>

#include "sublimit/patches/joins/join_orders.h"
#include "sublimit/surface/limit_map.h"

namespace sublimit {

/// A surface along an edge.
struct EdgeSide {
  /// Points at 0 <= s <= 1 with derivatives up to order 2 and normals.
  std::function<LimitSamples(std::span<const double> s)> evaluate;
  bool along_v = true;  ///< the edge is a line of constant u, else of constant v
  double sign = 1;      ///< +-1: the normal is sign times du x dv, on the same side of the join for both surfaces
};

/// A maximum on an edge.
struct EdgeMaximum {
  double value = 0;
  double s = 0;                      ///< its parameter on the edge
  std::array<double, 3> point = {};  ///< the point there of the left surface
};

/// Largest deviations on an edge.
struct EdgeDeviation {
  EdgeMaximum gap{};
  std::optional<EdgeMaximum> angle{};           ///< between normals, radians; nothing if a surface has none
  std::optional<EdgeMaximum> curvature_jump{};  ///< 1/length
  double greatest_curvature = 0;                ///< largest curvature of either surface across the edge
  bool has_pole = false;                        ///< true if a surface has no point somewhere on the edge
};

/// Returns the largest deviations on an edge: of `samples` equidistant places, refined by golden section search
/// around each maximum.
///
/// The curvature is that of normal sections perpendicular to the edge, with respect to the normals of the join: if they
/// agree, it decides on G^2 (Pegna, Wolter 1992). Where the area |du x dv| is below 1e-6 of its maximum on the
/// edge, normals count only if they are limits (LimitSamples); where it is below 1e-3, curvatures do not count,
/// since near a pole they are rounding.
/// @param samples  number of places, at least 2
EdgeDeviation measured_deviation(const EdgeSide& left, const EdgeSide& right, int samples);

/// Returns the orders of a join from deviations of derivatives.
/// @param c     largest k of C^k, from derivatives; -1 for a gap
/// @param size  size of the two pieces
JoinOrders measured_orders(const EdgeDeviation& deviation, int c, bool is_same, double size,
                           const JoinTolerance& tolerance);

}  // namespace sublimit
