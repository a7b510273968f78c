// SPDX-License-Identifier: Apache-2.0
#pragma once
// What is said of a join of two pieces. C^k: their derivatives up to order k agree, per unit of the given parameters.
// G^k: they do after the parameters of one piece are changed; G^1 is one tangent (plane) on both sides, G^2 one
// curvature too. C^k is G^k where the derivative does not vanish (the surface has normals), not elsewhere.
#include <string>
#include <string_view>

namespace sublimit {

/// Why g is not greater.
enum class JoinObstacle {
  none,         ///< g is the highest order that is looked for
  gap,          ///< the pieces do not meet
  pole,         ///< a denominator vanishes on the edge
  no_tangent,   ///< a side has no tangent or no normals there
  angle,        ///< tangents or normals differ
  folded_back,  ///< they agree up to the sign: both pieces lie on one side of the edge, somewhere at least
  undecided,    ///< on which sides they lie: normals vanish inside of the edge
  no_speed,     ///< curves: one tangent, but a derivative vanishes, so that there may be no curvature
  curvature,    ///< from the order g + 1 on, no change of parameters makes derivatives equal
};
/// `none`, `gap`, .. as files and messages have it.
std::string_view name(JoinObstacle obstacle);

struct JoinOrders {
  /// Greatest k of C^k and G^k; -1: a gap, or a pole. If `is_same` c, and if there is no obstacle g, is the highest
  /// order that was looked at: see `c_words`, `g_words`.
  int c = -1, g = -1;
  bool is_same = false;  ///< all derivatives that can differ agree: C^infinity, one polynomial or rational map
  JoinObstacle obstacle = JoinObstacle::gap;

  bool operator==(const JoinOrders&) const = default;
};

/// "C^1", or "C^infinity" where both pieces are one polynomial or rational map.
std::string c_words(const JoinOrders& orders);
/// "G^1"; "G^3 at least" where no order that was looked at fails; "G^infinity" of one map with a tangent (normals).
std::string g_words(const JoinOrders& orders);
/// "C^1, G^2 (curvature)", "a gap", "a pole".
std::string words_of(const JoinOrders& orders);

/// Returns the orders that hold on a whole edge, from those of two of its parts.
constexpr JoinOrders worst(const JoinOrders& a, const JoinOrders& b) {
  JoinOrders result = b.g < a.g ? b : a;
  result.c = b.c < a.c ? b.c : a.c;
  result.is_same = a.is_same && b.is_same;
  return result;
}

/// Tolerances of comparisons of rounded numbers.
struct JoinTolerance {
  double distance = 1e-9;   ///< relative to the size of the two pieces; derivatives: to what their terms are then
  double angle = 1e-8;      ///< radians
  double curvature = 1e-6;  ///< relative to the greatest curvature on the edge, or 1/size if that is more
};

}  // namespace sublimit
