// SPDX-License-Identifier: Apache-2.0
#pragma once
// Curve schemes: two masks, a rule for open ends, claims. As with surfaces, everything else (refined polygons, limits,
// derivatives) is computed from the matrices that the masks fill. Schemes of the library have names, and your own are
// made in the same way:
//
//   CurveScheme<double> scheme = curve_scheme("four-point", {{"tension", "3/4"}});
//   scheme = {.name = "midpoints",
//             .source = "here",
//             .masks = {.point = [](const CurveSite<double>& s) { return s.point(0); },
//                       .edge = [](const CurveSite<double>& s) { return (s.point(0) + s.point(1)) / 2; }}};
//
// Primal schemes make a point for every point and one for every edge; dual ones two points for every point, a quarter
// of an edge before and after it. Hermite schemes have a second unknown at every point: the derivative, per edge of the
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

/// An open end of a polygon, argument of the rule for points beyond it.
template <class T>
class CurveEnd {
 public:
  /// @param site  site near the end, which the object refers to
  CurveEnd(const CurveSite<T>& site, bool left) : site_(&site), left_(left) {}
  CurveEnd(const CurveSite<T>&&, bool) = delete;
  /// Returns the end point (0), its neighbour (1), and so on into the polygon.
  /// @throws InvalidParameter  a point that the curve does not have
  Stencil<T> point(int i) const { return site_->from_end(i, left_); }
  static T ratio(int p, int q) { return Number<T>::ratio(p, q); }

 private:
  const CurveSite<T>* site_;
  bool left_;
};

/// Rule for open ends.
template <class T>
struct CurveEnds {
  /// Virtual point m = 1, 2, ... steps beyond the end. With this rule end points stay where they are, and in dual
  /// schemes the first and the last edge count half: the points lie at parameters 0, 1/2, 3/2, ..., n-5/2, n-2. If
  /// empty, new points that would need a point beyond the end are left out: the curve is shorter than the polygon.
  std::function<Stencil<T>(const CurveEnd<T>& end, int m)> beyond{};
  int points = 1;  ///< least number of points of the polygon that `beyond` needs
};

/// A point and its neighbours along the curve, argument of masks. Slots of stencils are steps from that point (for
/// Hermite schemes twice the steps, plus 1 for the derivative). The neighbourhood is unfolded: on a small closed
/// polygon several slots may be one point.
template <class T>
class CurveSite {
 public:
  /// Makes a site away from ends.
  explicit CurveSite(int level, int unknowns = 1) : level_(level), unknowns_(unknowns) {}
  /// Makes the site of point `at` of an open polygon of `size` points.
  /// @param ends  rule for its ends, which the object refers to
  CurveSite(int level, const CurveEnds<T>& ends, bool dual, Index at, Index size)
      : level_(level), ends_(&ends), at_(at), size_(size), margin_(dual ? 1 : 0) {}
  CurveSite(int, const CurveEnds<T>&&, bool, Index, Index) = delete;

  /// Returns the point i steps further along the curve; i may be negative.
  Stencil<T> point(int i) const { return ends_ ? absolute(at_ + i) : Stencil<T>(unknowns_ * i); }
  /// Returns the derivative at the point i steps further along the curve, in a Hermite scheme.
  /// @throws InvalidParameter  the scheme has no derivatives
  Stencil<T> derivative(int i) const {
    if (unknowns_ != 2)
      throw InvalidParameter(
          "a mask asks for a derivative, which points of Hermite schemes alone have; give the scheme "
          "the masks point_derivative and edge_derivative");
    return Stencil<T>(unknowns_ * i + 1);
  }
  /// Returns the level of the parent, 0 for the control polygon.
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

/// Masks of a curve scheme: `point` and `edge` of a primal one, `before` and `after` of a dual one, the first four of a
/// Hermite scheme.
template <class T>
struct CurveMasks {
  using Mask = std::function<Stencil<T>(const CurveSite<T>&)>;
  Mask point{};                                ///< primal: the child of point(0)
  Mask edge{};                                 ///< primal: the child of the edge from point(0) to point(1)
  Mask point_derivative{}, edge_derivative{};  ///< Hermite: the derivatives there, per edge of the child
  Mask before{};                               ///< dual: the child of point(0) on its edge from point(-1)
  Mask after{};                                ///< dual: the child of point(0) on its edge to point(1)

  /// True if the masks are those of a dual scheme.
  bool dual() const { return static_cast<bool>(before); }
  /// Returns the number of unknowns at every point: 1, or 2 (point and derivative) for a Hermite scheme.
  int unknowns() const { return edge_derivative ? 2 : 1; }
  /// Returns the mask of a child of a point and the edge after it.
  /// @param which      0 for the first child (`point`, `before`), 1 for the second (`edge`, `after`)
  /// @param component  0 for the point, 1 for the derivative of a Hermite scheme
  const Mask& child(int which, int component = 0) const {
    if (component == 1) return which == 0 ? point_derivative : edge_derivative;
    return which == 0 ? (dual() ? before : point) : (dual() ? after : edge);
  }
};

/// Properties that a curve scheme is said to have. No result depends on them; each has its law in the tests.
struct CurveClaims {
  int regular = 0;           ///< the limit is C^regular
  int generates = 1;         ///< polynomials up to this degree are limits (away from ends)
  int reproduces = 1;        ///< polynomials up to this degree are the limits of their values at the points' parameters
  bool convex_hull = false;  ///< no negative weights
  bool interpolates = false;  ///< old points stay
  std::string limit;          ///< the limit curve, in words
  std::string exponent;       ///< Hoelder exponent of the limit, in words
};

/// A curve scheme. Threads may share one whose masks may be called by several threads, as those of the library may.
template <class T>
struct CurveScheme {
  std::string name;
  std::string source;  ///< author, year, title
  CurveMasks<T> masks;
  CurveEnds<T> ends = {};
  CurveClaims claims;
  std::vector<OptionInfo> options = {};
};

/// Returns a scheme of the library by its name: `curve_scheme("chaikin")`,
/// `curve_scheme("four-point", {{"tension", "3/4"}})`.
/// @throws InvalidOption  no linear scheme of curves has this name: says which are nearest, or what makes it; an
///                        unknown option, or a value outside its range
[[nodiscard]] CurveScheme<double> curve_scheme(const std::string& name, const SchemeOptions& options = {});

}  // namespace sublimit
