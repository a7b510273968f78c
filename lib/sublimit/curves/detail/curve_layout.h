// SPDX-License-Identifier: Apache-2.0
#pragma once
// Layout of refined curves: where the points of a level lie, and which point of the level before each comes
// from.
//
//   const CurveLayout layout(curve_scheme("chaikin"));
//   const CurveOutline control = layout.control(5, false), next = layout.child(control);  // open, 5 points
//   const auto [parent, mask] = layout.source(control, next, 3);
//   const double t = layout.parameter(next, 1, 3);
//
// Positions are counted in half edges of their own level, so that they are whole numbers and double from level
// to level; 0 is where the limit of an open curve starts. Points of a level are at
//
// - primal, kept ends: 0, 2, 4, ...; a point at X and the middle of its edge have the children 2X and 2X + 2
// - dual, kept ends: 0, 1, 3, 5, ..., 2n - 4; the children of an inner point lie at 2X - 1 and 2X + 1
// - free ends: -s, 2 - s, 4 - s, ...; the limit starts s/2 edges after the first point
// - closed: X, X + 2, ..., modulo 2n; X = 0 for primal schemes and 2^(k+1) - 1 for dual ones; the children of a
//   dual
// scheme's edge a are 2a and 2a + 1
#include <algorithm>
#include <cassert>
#include <cstdint>
#include <cstdlib>

#include "sublimit/curves/curve_refine.h"
#include "sublimit/curves/detail/check_curve_scheme.h"

namespace sublimit {

/// Largest number of points along the curve, or of their unknowns, that a mask may reach: far beyond any
/// scheme.
inline constexpr Index curve_reach = 1 << 16;

/// Positions and children of the points of curves under a scheme, computed from its masks. It never changes:
/// threads may share it.
class CurveLayout {
 public:
  /// Makes the layout of a scheme, for curves of level `level`.
  /// @throws InvalidParameter  an incomplete scheme (`check_scheme`), masks that are not affine or reach
  ///                           differently far
  template <class T>
  explicit CurveLayout(const CurveScheme<T>& scheme, int level = 0)
      : dual_(check_scheme(scheme).masks.dual()),
        kept_(static_cast<bool>(scheme.ends.beyond)),
        unknowns_(scheme.masks.unknowns()),
        end_points_(scheme.ends.points) {
    const CurveSite<T> site(level, unknowns_);
    for (int which : {0, 1}) {
      for (int component = 0; component < unknowns_; ++component) {
        const Stencil<T> mask =
            check_mask(scheme, which, component, scheme.masks.child(which, component)(site), -curve_reach, curve_reach);
        low_[which] = std::min(low_[which], steps(mask.terms().front().first));
        high_[which] = std::max(high_[which], steps(mask.terms().back().first));
      }
      for (const int slot : {low_[which], high_[which]})
        radius_ = std::max(radius_, std::abs(child_offset(which) - 4 * slot));
    }
    if (kept_) return;
    const int starts[] = {-4 * low_[0] + child_offset(0), -4 * low_[1] + child_offset(1)};
    start_ = std::min(starts[0], starts[1]);
    if (std::abs(starts[0] - starts[1]) != 2)
      throw InvalidParameter(scheme.name +
                             " has masks that reach differently far along the curve, so that children are "
                             "missing at free ends; give it a rule for the points beyond (ends.beyond)");
  }

  /// True if each point has two children and edges have none.
  bool is_dual() const { return dual_; }
  /// Returns the number of unknowns at every point: 1, or 2 for a Hermite scheme.
  int unknowns() const { return unknowns_; }
  /// Returns the distance of a stencil's slot from the site's own point, in points along the curve.
  int steps(Index slot) const { return (slot - (slot % unknowns_ + unknowns_) % unknowns_) / unknowns_; }
  /// True if end points stay where they are, and are points of the limit.
  bool keeps_ends() const { return kept_; }
  /// Returns the radius of masks in half edges: |X_child - 2 X_parent| <= radius for all parents with weight. A
  /// neighbourhood of this radius refines to one that depends on nothing else.
  int radius() const { return radius_; }
  /// Returns the least position of a point that masks may use, on an open curve.
  int begin() const { return kept_ ? (dual_ ? 1 : 0) : -start_; }

  /// Returns the least number of points that a curve must have.
  Index least_points(bool closed) const {
    if (closed) return 3;
    return kept_ ? std::max(end_points_, dual_ ? 3 : 2) : start_ + 2;
  }
  /// Returns the number of points that the rule for open ends needs (`CurveEnds::points`).
  int end_points() const { return end_points_; }

  /// Returns the outline of a control curve of `size` points.
  CurveOutline control(Index size, bool closed) const {
    return {size, closed, closed ? (dual_ ? 1 : 0) : kept_ ? 0 : -start_};
  }
  /// Returns the outline of a curve after one step.
  CurveOutline child(const CurveOutline& c) const {
    if (c.closed) return {2 * c.size, true, dual_ ? 2 * c.first + 1 : 0};
    if (kept_) return {2 * c.size - (dual_ ? 2 : 1), false, 0};
    return {2 * c.size - (high_[0] - low_[0]) - (high_[1] - low_[1]), false, c.first};
  }

  /// Returns the position of point `a`.
  std::int64_t position(const CurveOutline& c, Index a) const {
    if (!c.closed && kept_ && dual_) return a == 0 ? 0 : a == c.size - 1 ? 2 * a - 2 : 2 * a - 1;
    return c.first + 2 * std::int64_t{a};
  }
  /// Returns the number of the point at a position.
  Index point(const CurveOutline& c, std::int64_t position) const {
    if (!c.closed && kept_ && dual_) return static_cast<Index>((position + 1) / 2 + (position == 2 * c.size - 4));
    const std::int64_t a = (position - c.first) / 2;
    assert(2 * a == position - c.first);
    return static_cast<Index>(c.closed ? (a % c.size + c.size) % c.size : a);
  }
  /// Returns the position at which the limit of an open curve ends.
  std::int64_t end(const CurveOutline& c) const {
    return kept_ ? position(c, c.size - 1) : c.first + position(c, c.size - 1);
  }
  /// Returns the parameter of point `a` of level `number`, in edges of the control polygon.
  ///
  /// Control point i has parameter i, and with kept ends in a dual scheme 0, 1/2, 3/2, ... A closed curve of n
  /// control points has the parameters modulo n.
  double parameter(const CurveOutline& c, int number, Index a) const;

  /// Origin of a point of the next level.
  struct Source {
    Index parent;  ///< parent point
    int mask;      ///< mask at the parent, 0 or 1; -1: a copy of the parent
  };
  /// Returns parent point and mask of child point `j`.
  Source source(const CurveOutline& parent, const CurveOutline& child, Index j) const {
    if (!child.closed && kept_ && j == 0) return {0, -1};
    if (!child.closed && kept_ && j == child.size - 1) return {parent.size - 1, -1};
    const std::int64_t base = !parent.closed && kept_ && dual_ ? -1 : parent.first;
    const std::int64_t from_first = position(child, j) - 2 * base - child_offset(0);
    const int mask = from_first % 4 == 0 ? 0 : 1;
    return {static_cast<Index>((from_first + child_offset(0) - child_offset(mask)) / 4), mask};
  }

 private:
  int child_offset(int which) const { return dual_ ? 2 * which - 1 : 2 * which; }

  bool dual_, kept_;
  int unknowns_, end_points_, radius_ = 0, start_ = 0;
  int low_[2] = {0, 0}, high_[2] = {0, 0};
};

}  // namespace sublimit
