// SPDX-License-Identifier: Apache-2.0
#pragma once
// The blossom (polar form) of a polynomial piece of a B-spline, from which all rows of patches are computed.
// f(x_1, .., x_p) is symmetric, affine in each argument, and f(t, .., t) is the curve; homogenised, an argument
// is a pair (x, w): (t, 1) is a point, (d, 0) a direction, and the r-th derivative along d is
//
//   p!/(p-r)! f((d,0)^r, (t,1)^(p-r))
//
// Control points are values at consecutive knots, P_i = f(t_{i+1}, .., t_{i+p}); so are those of any other net of the
// same curve: finer knots, a higher degree, a Bezier piece, other end knots.
// Source: Ramshaw 1989, "Blossoms are polar forms".
#include <algorithm>
#include <cassert>
#include <span>

#include "sublimit/core/types.h"

namespace sublimit {

/// An argument of a blossom, stored such that its distances to knots are computed without cancellation.
template <class T>
class BlossomArgument {
 public:
  BlossomArgument() = default;
  static BlossomArgument point(const T& t) { return {t, t, T(0), T(0), false}; }
  static BlossomArgument direction(const T& d) { return {T(0), T(0), d, T(-d), true}; }
  /// Returns the point (1 - u) a + u b. Its distances to knots outside a .. b are sums of positive terms.
  static BlossomArgument between(const T& a, const T& b, const T& u) {
    const T length = b - a;
    return {a, b, T(u * length), T((T(1) - u) * length), false};
  }

  /// x - w t
  T after(const T& t) const { return is_direction_ ? above_ : T((low_ - t) + above_); }
  /// w t - x
  T before(const T& t) const { return is_direction_ ? below_ : T((t - high_) + below_); }

 private:
  BlossomArgument(const T& low, const T& high, const T& above, const T& below, bool is_direction)
      : low_(low), high_(high), above_(above), below_(below), is_direction_(is_direction) {}

  T low_{}, high_{}, above_{}, below_{};  // x = low + above = high - below
  bool is_direction_ = false;
};

/// Knots around a span for step q: left(q, r) from far to near and right(r) from near to far, r = 0 .. q-1.
template <class T>
struct SpanKnots {
  std::span<const T> knots;
  Index k = 0;
  const T& left(Index q, Index r) const { return knots[k - q + 1 + r]; }
  const T& right(Index r) const { return knots[k + 1 + r]; }
};

/// Knots of a Bezier piece over [0, 1]: 0 on the left, 1 on the right. Used with arguments UnitArgument.
template <class T>
struct UnitSpan {
  static constexpr T left(Index, Index) { return T(0); }
  static constexpr T right(Index) { return T(1); }
};
template <class T>
struct UnitArgument {
  T above, below;  // x and 1 - x of a point, d and -d of a direction
  static UnitArgument point(const T& u) { return {u, T(1) - u}; }
  static UnitArgument direction() { return {T(1), T(-1)}; }
  const T& after(const T&) const { return above; }
  const T& before(const T&) const { return below; }
};

/// Adds argument q to the weights of a blossom, in place.
/// @param weights  the q weights after q - 1 arguments, with room for one more
template <class Span, class Argument, class T>
inline void blossom_step(const Span& span, Index q, const Argument& x, T* weights) {
  T carried(0);
  for (Index r = 0; r < q; ++r) {
    // The knots of step q on both sides of the span; they differ, since the span is not empty.
    const T &left = span.left(q, r), &right = span.right(r);
    const T share = weights[r] / (right - left);
    weights[r] = carried + share * x.before(right);
    carried = share * x.after(left);
  }
  weights[q] = carried;
}

/// Computes the weights of the blossom of the piece in span k over the control points k-p .. k, where p is the
/// number of arguments.
///
/// Inside the span the weights of a point (all arguments equal) are sums of positive terms. Derivatives stay near the
/// rounding of their terms if directions come last.
/// @param knots      t_0 <= t_1 <= ..; t_k < t_{k+1}, and k-p+1 .. k+p exist
/// @param arguments  in the order of the steps; any order gives the same up to rounding
/// @param weights    the result, p+1 numbers
template <class T>
void blossom(std::span<const T> knots, Index k, std::span<const BlossomArgument<T>> arguments, std::span<T> weights) {
  const Index degree = static_cast<Index>(arguments.size());
  assert(k >= degree - 1 && k + std::max<Index>(degree, 1) < std::ssize(knots) && knots[k] < knots[k + 1]);
  weights[0] = T(1);
  for (Index q = 1; q <= degree; ++q) blossom_step(SpanKnots<T>{knots, k}, q, arguments[q - 1], weights.data());
}

/// Orders arguments that are knots, or points between knots, such that weights are computed without
/// cancellation: first those up to the start of the span in descending order, then those after it in ascending
/// order. If every knot of the piece between two arguments is an argument too, as in any refinement, all terms
/// are positive.
/// @param points  ascending; reordered
template <class T>
void order_for_span(std::span<T> points, const T& span_begin) {
  const auto after = std::upper_bound(points.begin(), points.end(), span_begin);
  std::reverse(points.begin(), after);
}

}  // namespace sublimit
