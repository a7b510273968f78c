// SPDX-License-Identifier: Apache-2.0
#pragma once
// Orders of continuity of a join of two pieces. C^k: derivatives up to order k agree, per unit of the given
// parameters. G^k: they agree after a change of the parameters of one piece; G^1 is a common tangent (plane),
// G^2 also a common curvature. C^k implies G^k where the derivative does not vanish (the surface has normals),
// but not elsewhere.
#include <string>
#include <string_view>

namespace sublimit {

/// Reason why g is not larger.
enum class JoinObstacle {
  none,         ///< g is the highest order that is examined
  gap,          ///< the pieces do not meet
  pole,         ///< a denominator vanishes on the edge
  no_tangent,   ///< a piece has no tangent, or no normals, there
  angle,        ///< tangents or normals differ
  folded_back,  ///< tangents or normals are opposite: both pieces lie on one side of the edge, at least somewhere
  undecided,    ///< it is undecided on which sides pieces lie: normals vanish in the interior of the edge
  no_speed,     ///< curves: common tangent, but a derivative vanishes, so that there may be no curvature
  curvature,    ///< no change of parameters makes derivatives of order g + 1 equal
};
/// Returns the name in files and messages: `none`, `gap`, ..
std::string_view name(JoinObstacle obstacle);

/// Orders of a join.
struct JoinOrders {
  /// Largest k of C^k and G^k; -1: a gap or a pole. c is the highest order examined if `is_same`, and g if
  /// there is no obstacle; see `c_words`, `g_words`.
  int c = -1, g = -1;
  bool is_same = false;  ///< all derivatives agree: both pieces are one polynomial or rational map
  JoinObstacle obstacle = JoinObstacle::gap;

  bool operator==(const JoinOrders&) const = default;
};

/// Returns "C^1", or "C^infinity" if both pieces are one polynomial or rational map.
std::string c_words(const JoinOrders& orders);
/// Returns "G^1"; "G^3 at least" if no order examined fails; "G^infinity" for one map with a tangent (normals).
std::string g_words(const JoinOrders& orders);
/// Returns "C^1, G^2 (curvature)", "a gap" or "a pole".
std::string words_of(const JoinOrders& orders);

/// Returns the orders that hold on a whole edge, from those of two of its parts.
constexpr JoinOrders worst(const JoinOrders& a, const JoinOrders& b) {
  JoinOrders result = b.g < a.g ? b : a;
  result.c = b.c < a.c ? b.c : a.c;
  result.is_same = a.is_same && b.is_same;
  return result;
}

/// Tolerances of comparisons of floating-point numbers.
struct JoinTolerance {
  double distance = 1e-9;   ///< relative to the size of both pieces; for derivatives, to the size of their terms
  double angle = 1e-8;      ///< radians
  double curvature = 1e-6;  ///< relative to the largest curvature on the edge, or to 1/size if larger
};

}  // namespace sublimit
