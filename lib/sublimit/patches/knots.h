// SPDX-License-Identifier: Apache-2.0
#pragma once
// Knots of a B-spline in one variable.
//
//   const auto knots = Knots<double>::open(3, 5, {0, 0, 0, 0, 0.5, 1, 1, 1, 1});  // cubic, 5 control points
//   const KnotPlace<double> place = knots.place(0.75);                            // face 1, u = 0.5
//   const std::vector<double> abscissae = knots.greville();
//
// Knots t_0 <= t_1 <= .. of degree p. Basis function i has the support [t_i, t_{i+p+1}];
// the domain is [t_p, t_n], and its spans that are not empty are the faces, in order. An open spline of n control
// points has n + p + 1 knots; a closed one of N points has the break points tau_0 .. tau_N = t_p .. t_{p+N}, which go
// on with the period on both sides, and its basis functions i and i + N have the same control point: any N >= 1 is
// fine.
//
// At a knot of multiplicity r inside the domain the curve is C^{p-r}: r = p touches a control point, r = p + 1 jumps.
#include <algorithm>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "sublimit/core/types.h"

namespace sublimit {

/// Largest degree of B-splines.
inline constexpr int max_degree = 25;

// Checks of knots, shared by all number types. Errors name the knot and the control point, with the counts that would
// be right; numbers are reported as the nearest double.

/// Faults of a knot.
enum class KnotFault {
  not_finite,
  falling,         ///< less than the knot before
  too_near,        ///< too near to the knot before for a knot between them
  missing,         ///< a coarse knot that the finer knots lack
  another_domain,  ///< finer knots with another domain
};

/// Throws unless a degree is 0 to max_degree.
/// @throws InvalidParameter  another degree
void check_degree(int degree);
/// Throws unless the number of knots fits that of control points.
/// @return  true if the first and the last knot are left out
/// @throws InvalidParameter  too few points, or neither n + p + 1 nor n + p - 1 knots
bool check_knot_count(int degree, Index points, std::size_t knots);
/// Throws unless two degrees are equal.
/// @throws InvalidParameter  different degrees
void check_same_degree(int wanted, int degree);
/// Throws unless a closed curve has at least two break points.
/// @param breaks  number of break points: one more than control points
/// @throws InvalidParameter  fewer
void check_break_count(std::size_t breaks);
/// Reports a fault of a knot.
/// @param knot   number of the knot
/// @param value  the knot
/// @param other  the knot before, or the end of the correct domain
/// @throws InvalidParameter  always
[[noreturn]] void refuse_knot(KnotFault fault, Index knot, double value, double other = 0);
/// Reports more than degree + 1 equal knots, the first of them number `knot`: a control point has no influence.
/// @throws InvalidParameter  always
[[noreturn]] void refuse_multiplicity(int degree, Index knot, double value, Index times, Index point);
/// Reports a domain without length, from knot `first` to knot `last`.
/// @throws InvalidParameter  always
[[noreturn]] void refuse_domain(Index first, Index last, double value);
/// Reports a parameter outside the domain.
/// @throws InvalidParameter  always
[[noreturn]] void refuse_parameter(double t, double begin, double end);

/// Side of a knot: the piece that a knot as a parameter belongs to, or an end of a face.
enum class KnotSide { left, right };

/// A place in one variable: a face, and a parameter in it.
template <class T>
struct KnotPlace {
  Index face = 0;
  T u{};  ///< 0 at the start of the face, 1 at its end
};

/// Knots in numbers of type T: double, or exact ones. They never change: threads may share them.
template <class T>
class Knots {
 public:
  /// Makes the knots of an open spline.
  /// @param points  number of control points
  /// @param knots   points + degree + 1 knots; if there are two less, as in openNURBS, the first and the last are
  ///                doubled
  /// @throws InvalidParameter  naming the knot: a wrong count or degree, falling or not finite, more than degree + 1
  ///                           equal ones, a domain without length
  static Knots open(int degree, Index points, std::vector<T> knots) {
    check_degree(degree);
    Knots result;
    result.ends_doubled_ = check_knot_count(degree, points, knots.size());
    check_order(knots);
    if (result.ends_doubled_) {
      knots.insert(knots.begin(), T(knots.front()));
      knots.push_back(T(knots.back()));
    }
    result.degree_ = degree;
    result.num_points_ = points;
    result.knots_ = std::move(knots);
    result.find_faces();
    return result;
  }
  /// Makes the knots of a closed spline of N control points.
  /// @param breaks  tau_0 .. tau_N; the first piece uses the points 0 .. degree
  /// @throws InvalidParameter  as `open`
  static Knots closed(int degree, const std::vector<T>& breaks) {
    check_degree(degree);
    check_break_count(breaks.size());
    check_order(breaks);
    Knots result;
    result.degree_ = degree;
    result.num_points_ = static_cast<Index>(breaks.size()) - 1;
    result.is_closed_ = true;
    const Index N = result.num_points_;
    const T period = breaks.back() - breaks.front();
    // Distances from the ends of the domain are taken from the breaks: equal breaks stay equal.
    for (Index m = degree; m > 0; --m)
      result.knots_.push_back(breaks.front() - (T(m / N) * period + (breaks[N] - breaks[N - m % N])));
    result.knots_.insert(result.knots_.end(), breaks.begin(), breaks.end());
    for (Index m = 1; m <= degree; ++m)
      result.knots_.push_back(breaks.back() + (T(m / N) * period + (breaks[m % N] - breaks[0])));
    result.find_faces();
    return result;
  }

  int degree() const { return degree_; }
  bool is_closed() const { return is_closed_; }
  /// True if knots were given without the first and the last.
  bool ends_were_doubled() const { return ends_doubled_; }
  /// Returns the number of control points: n, or N of a closed spline.
  Index num_points() const { return num_points_; }
  /// Returns the number of basis functions; a closed spline has more than control points.
  Index num_functions() const { return static_cast<Index>(knots_.size()) - degree_ - 1; }
  /// Returns the control point of a basis function.
  Index point(Index function) const { return is_closed_ ? function % num_points_ : function; }
  /// Returns a basis function of a control point that is not zero on all of the domain. (An open spline may have a
  /// control point without one, if knots at the start of the domain are repeated and others come before it.)
  Index function(Index point) const {
    return is_closed_ && !(begin() < knots_[point + degree_ + 1]) ? point + num_points_ : point;
  }
  /// Returns all knots, including those beyond the domain.
  std::span<const T> all() const { return knots_; }
  /// Returns the break points of a closed spline, or the knots in the domain of an open one.
  std::span<const T> in_domain() const { return all().subspan(degree_, num_functions() - degree_ + 1); }

  /// Returns the start of the domain.
  const T& begin() const { return knots_[degree_]; }
  /// Returns the end of the domain.
  const T& end() const { return knots_[num_functions()]; }
  /// Returns the number of spans of the domain that are not empty.
  Index num_faces() const { return static_cast<Index>(spans_.size()); }
  /// Returns k of a face's span [t_k, t_{k+1}]; the basis functions k-p .. k are not zero there.
  Index span(Index face) const { return spans_[face]; }
  /// Returns the length of a face's span.
  T length(Index face) const { return knots_[spans_[face] + 1] - knots_[spans_[face]]; }

  /// Returns the place of a parameter. A knot belongs to the piece on its right, the end of the domain to the last
  /// piece.
  /// @param side  left: a knot belongs to the piece on its left, and the start of a closed spline's domain to the last
  ///              piece
  /// @throws InvalidParameter  a parameter outside the domain
  KnotPlace<T> place(const T& t, KnotSide side = KnotSide::right) const {
    if (!(begin() <= t && t <= end()))
      refuse_parameter(static_cast<double>(t), static_cast<double>(begin()), static_cast<double>(end()));
    if (side == KnotSide::left && t == begin() && is_closed_) return {num_faces() - 1, T(1)};
    const auto first = spans_.begin() + 1;  // the first face is for all that is before the second one
    const auto beyond = std::partition_point(
        first, spans_.end(), [&](Index k) { return side == KnotSide::left ? knots_[k] < t : knots_[k] <= t; });
    const auto face = static_cast<Index>(beyond - first);
    const Index k = spans_[face];
    return {face, T((t - knots_[k]) / (knots_[k + 1] - knots_[k]))};
  }
  /// Returns the parameter of a place.
  T parameter(const KnotPlace<T>& place) const {
    const T &a = knots_[spans_[place.face]], &b = knots_[spans_[place.face] + 1];
    return place.u == T(1) ? b : std::min(b, T(a + place.u * (b - a)));
  }

  /// Returns k of the continuity C^k between a face and its neighbour, -1 for a jump; nothing at the ends of an open
  /// spline.
  std::optional<int> continuity(Index face, KnotSide end) const {
    if (end == KnotSide::right) ++face;
    if (!is_closed_ && (face == 0 || face == num_faces())) return std::nullopt;
    const Index k = spans_[face % num_faces()];  // the last of its equals
    return degree_ - (k - static_cast<Index>(first_equal(k)) + 1);
  }

  /// Returns the Greville abscissae: for every basis function the mean of its inner knots, so that sum g_i N_i(t) = t;
  /// at degree 0 the middle of its span.
  std::vector<T> greville() const {
    std::vector<T> result;
    for (Index i = 0; i < num_functions(); ++i) {
      const Index first = degree_ == 0 ? i : i + 1, count = degree_ == 0 ? 2 : degree_;
      T sum(0);
      for (Index j = first; j < first + count; ++j) sum += knots_[j];
      result.push_back(sum / T(count));
    }
    return result;
  }

  /// Returns the numbers that the rows of a face depend on: distances of the p - 1 knots on either side from its ends,
  /// in units of its length. Faces of equal types have equal rows.
  std::vector<T> type(Index face) const {
    const Index k = spans_[face];
    const T unit = length(face);
    std::vector<T> result;
    for (Index j = 1; j < degree_; ++j) result.push_back((knots_[k] - knots_[k - j]) / unit);
    for (Index j = 1; j < degree_; ++j) result.push_back((knots_[k + 1 + j] - knots_[k + 1]) / unit);
    return result;
  }

 private:
  Knots() = default;

  static void check_order(const std::vector<T>& knots) {
    const auto number = [&](size_t i) { return static_cast<double>(knots[i]); };
    for (size_t i = 0; i < knots.size(); ++i) {
      if (!(knots[i] - knots[i] == T(0))) refuse_knot(KnotFault::not_finite, static_cast<Index>(i), number(i));
      if (i > 0 && knots[i] < knots[i - 1])
        refuse_knot(KnotFault::falling, static_cast<Index>(i), number(i), number(i - 1));
    }
  }
  void find_faces() {
    const Index first = degree_, last = num_functions();
    if (!(knots_[first] < knots_[last])) refuse_domain(first, last, static_cast<double>(knots_[first]));
    for (Index i = 0; i + degree_ + 1 < std::ssize(knots_); ++i) {
      if (knots_[i] < knots_[i + degree_ + 1]) continue;
      const auto equal = std::count(knots_.begin(), knots_.end(), knots_[i]);
      // As the caller counts them.
      const Index number = is_closed_ ? ((i - degree_) % num_points_ + num_points_) % num_points_ : i - ends_doubled_;
      refuse_multiplicity(degree_, std::max(number, 0), static_cast<double>(knots_[i]), static_cast<Index>(equal),
                          point(i));
    }
    for (Index k = first; k < last; ++k)
      if (knots_[k] < knots_[k + 1]) spans_.push_back(k);
  }
  std::ptrdiff_t first_equal(Index k) const {
    return std::lower_bound(knots_.begin(), knots_.end(), knots_[k]) - knots_.begin();
  }

  int degree_ = 0;
  Index num_points_ = 0;
  bool is_closed_ = false, ends_doubled_ = false;
  std::vector<T> knots_;
  std::vector<Index> spans_;
};

/// Returns the knots 0 .. 0 1 .. 1, with which a B-spline is a Bezier curve.
template <class T>
Knots<T> bezier_knots(int degree) {
  check_degree(degree);
  std::vector<T> knots(2 * static_cast<size_t>(degree) + 2, T(0));
  std::fill(knots.begin() + degree + 1, knots.end(), T(1));
  return Knots<T>::open(degree, degree + 1, std::move(knots));
}

}  // namespace sublimit
