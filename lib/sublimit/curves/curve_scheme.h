// SPDX-License-Identifier: Apache-2.0
#pragma once
// A curve scheme: two masks, what to do at open ends, claims. As with surfaces, everything else (refined polygons,
// limits, derivatives) is computed from the matrices that the masks fill.
//
// Primal schemes make a point for every point and one for every leg; dual ones two points for every point, a quarter of
// a leg before and after it. Hermite schemes have a second unknown at every point: the derivative, per leg of the
// level.
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "sublimit/base/error.h"
#include "sublimit/core/number.h"
#include "sublimit/core/scheme_options.h"
#include "sublimit/core/stencil.h"

namespace sublimit {

template <class T>
class CurveSite;

/// An open end of a polygon, as the rule for the points beyond it sees it.
template <class T>
class CurveEnd {
 public:
  /// @param site  which must stay
  CurveEnd(const CurveSite<T>& site, bool left) : site_(&site), left_(left) {}
  CurveEnd(const CurveSite<T>&&, bool) = delete;
  /// The end point (0), its neighbour (1), and so on into the polygon.
  Stencil<T> point(int i) const { return site_->from_end(i, left_); }
  static T ratio(int p, int q) { return Number<T>::ratio(p, q); }

 private:
  const CurveSite<T>* site_;
  bool left_;
};

/// What happens at open ends.
template <class T>
struct CurveEnds {
  /// The point m = 1, 2, ... steps beyond the end. With this rule end points stay where they are, and in dual schemes
  /// the first and the last leg count half: the points lie at parameters 0, 1/2, 3/2, ..., n-5/2, n-2. Empty: new
  /// points that would need a point beyond the end are left out, and the curve is shorter than the polygon.
  std::function<Stencil<T>(const CurveEnd<T>& end, int m)> beyond{};
  int points = 1;  ///< points of the polygon that `beyond` needs
};

/// Where a mask is applied: a point and its neighbours along the curve. Slots of stencils are steps from that point
/// (for Hermite schemes 2 steps, and 1 more for the derivative); the neighbourhood is unfolded, so on a small closed
/// polygon several slots may be one point.
template <class T>
class CurveSite {
 public:
  /// A site away from ends.
  explicit CurveSite(int level, int unknowns = 1) : level_(level), unknowns_(unknowns) {}
  /// Point `at` of an open polygon.
  /// @param ends  which must stay
  CurveSite(int level, const CurveEnds<T>& ends, bool dual, Index at, Index size)
      : level_(level), ends_(&ends), at_(at), size_(size), margin_(dual ? 1 : 0) {}
  CurveSite(int, const CurveEnds<T>&&, bool, Index, Index) = delete;

  /// The point i steps further along the curve.
  Stencil<T> point(int i) const { return ends_ ? absolute(at_ + i) : Stencil<T>(unknowns_ * i); }
  /// The derivative there, in a Hermite scheme.
  /// @throws InvalidParameter  the scheme has no derivatives
  Stencil<T> derivative(int i) const {
    if (unknowns_ != 2)
      throw InvalidParameter(
          "a mask asks for a derivative, which points of Hermite schemes alone have; give the scheme "
          "the masks point_derivative and leg_derivative");
    return Stencil<T>(unknowns_ * i + 1);
  }
  /// Level of the parent, 0 for the control polygon.
  int level() const { return level_; }
  static T ratio(int p, int q) { return Number<T>::ratio(p, q); }
  static T cos_2pi(int k, int n) { return Number<T>::cos_2pi(k, n); }

 private:
  friend class CurveEnd<T>;
  Stencil<T> from_end(int i, bool left) const {
    if (i < 0 || i >= size_)
      throw InvalidParameter("the rule for points beyond an end asks for point " + std::to_string(i) +
                             " of a curve of " + std::to_string(size_) + "; 0 to " + std::to_string(size_ - 1) +
                             " exist");
    const Index a = left ? i : size_ - 1 - i;
    return i == 0 ? Stencil<T>(a - at_) : absolute(a);
  }
  Stencil<T> absolute(Index a) const {
    const Index last = size_ - 1 - margin_;
    if (a < margin_) return ends_->beyond(CurveEnd<T>(*this, true), margin_ - a);
    if (a > last) return ends_->beyond(CurveEnd<T>(*this, false), a - last);
    return Stencil<T>(a - at_);
  }

  int level_, unknowns_ = 1;
  const CurveEnds<T>* ends_ = nullptr;
  Index at_ = 0, size_ = 0, margin_ = 0;
};

/// Two of these are given: `point` and `leg`, or `before` and `after`; of a Hermite scheme the first four.
template <class T>
struct CurveMasks {
  using Mask = std::function<Stencil<T>(const CurveSite<T>&)>;
  Mask point{};                               ///< primal: the child of point(0)
  Mask leg{};                                 ///< primal: the child of the leg from point(0) to point(1)
  Mask point_derivative{}, leg_derivative{};  ///< Hermite: the derivatives there, per leg of the child
  Mask before{};                              ///< dual: the child of point(0) on its leg from point(-1)
  Mask after{};                               ///< dual: the child of point(0) on its leg to point(1)

  bool dual() const { return static_cast<bool>(before); }
  /// At every point: itself, and in a Hermite scheme the derivative.
  int unknowns() const { return leg_derivative ? 2 : 1; }
  /// The mask of unknown `component` of the two children that a point (and its leg) has.
  const Mask& child(int which, int component = 0) const {
    if (component == 1) return which == 0 ? point_derivative : leg_derivative;
    return which == 0 ? (dual() ? before : point) : (dual() ? after : leg);
  }
};

/// What a curve scheme is said to do, each claim with its law in the tests.
struct CurveClaims {
  int regular = 0;            ///< the limit is C^regular
  int generates = 1;          ///< polynomials up to this degree are limits (away from ends)
  int reproduces = 1;         ///< they are the limits of their own values at the parameters of the points
  bool convex_hull = false;   ///< no negative weights
  bool interpolates = false;  ///< old points stay
  std::string limit;          ///< in words
  std::string exponent;       ///< Hoelder exponent of the limit, in words
};

template <class T>
struct CurveScheme {
  std::string name;
  std::string source;  ///< author, year, title
  CurveMasks<T> masks;
  CurveEnds<T> ends = {};
  CurveClaims claims;
  std::vector<OptionInfo> options = {};
};

}  // namespace sublimit
