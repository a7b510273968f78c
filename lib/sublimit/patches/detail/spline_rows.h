// SPDX-License-Identifier: Apache-2.0
#pragma once
// Rows of a B-spline in one variable, all computed as values of its blossom: points and derivatives, and the
// control points of the same curve over other knots. The latter give the matrices S of knot insertion, halving
// of all spans, Bezier extraction, change of end knots and degree elevation:
//
//   row_fine(t) S = row_coarse(t)
//
// Rows of points and of refinements have only non-negative terms, and are computed without cancellation.
// Source: Boehm 1980; Cohen, Lyche, Riesenfeld 1980; Prautzsch 1984; Borden et al. 2011.
#include <array>
#include <span>
#include <type_traits>
#include <vector>

#include "sublimit/patches/detail/blossom.h"
#include "sublimit/patches/knots.h"
#include "sublimit/source/rational.h"

namespace sublimit {

/// Rows of equal width over consecutive basis functions.
template <class T>
struct BandRows {
  Index width = 0;
  std::vector<Index> first{};  ///< basis function of a row's first weight
  std::vector<T> weights{};    ///< row by row

  Index size() const { return static_cast<Index>(first.size()); }
  std::span<const T> operator[](Index row) const {
    return std::span<const T>(weights).subspan(static_cast<size_t>(row) * width, width);
  }
  /// Appends a row of zeros, and returns it to be filled.
  std::span<T> add(Index first_function) {
    first.push_back(first_function);
    weights.resize(weights.size() + width, T(0));
    return std::span<T>(weights).last(width);
  }
};

/// The knots that the piece of a face depends on, and its span among them. Doubles are widened to long double,
/// so that rows are exact up to a final rounding.
template <class T>
struct PieceKnots {
  using Real = std::conditional_t<std::is_same_v<T, double>, long double, T>;

  std::array<Real, 2 * max_degree + 2> storage;  // widened knots; only those in use are set
  std::span<const Real> knots;
  Index span;

  PieceKnots(const Knots<T>& all, Index face) {
    const Index p = std::max(all.degree(), 1), k = all.span(face);
    if constexpr (std::is_same_v<T, Real>) {
      knots = all.all(), span = k;
    } else {
      std::copy_n(all.all().begin() + (k - p + 1), 2 * p, storage.begin());
      knots = std::span<const Real>(storage).first(2 * p), span = p - 1;
    }
  }
  PieceKnots(const PieceKnots&) = delete;

  void blossom(std::span<const BlossomArgument<Real>> arguments, const Real& factor, std::span<T> row) const {
    std::array<Real, max_degree + 1> weights;
    sublimit::blossom(knots, span, arguments, std::span<Real>(weights).first(row.size()));
    for (size_t i = 0; i < row.size(); ++i) row[i] = static_cast<T>(factor * weights[i]);
  }
};

/// Computes the rows of a place: position, then derivatives per unit of the face, each over the basis functions
/// span(face) - p .. span(face).
/// @param u     0 to 1; outside, rows are correct but have negative weights
/// @param rows  result, (order + 1) (p + 1) weights
template <class T>
void span_rows(const Knots<T>& knots, Index face, const T& u, int order, std::span<T> rows) {
  using Real = typename PieceKnots<T>::Real;
  const Index p = knots.degree();
  const PieceKnots<T> piece(knots, face);
  const Real &a = piece.knots[piece.span], &b = piece.knots[piece.span + 1];
  std::array<BlossomArgument<Real>, max_degree> arguments;
  std::fill_n(arguments.begin(), p, BlossomArgument<Real>::between(a, b, Real(u)));
  Real factor(1);  // p!/(p-r)!
  for (Index r = 0; r <= order; ++r) {
    const std::span<T> row = rows.subspan(static_cast<size_t>(r) * (p + 1), p + 1);
    if (r > p) {
      std::fill(row.begin(), row.end(), T(0));
      continue;
    }
    if (r > 0) {
      arguments[p - r] = BlossomArgument<Real>::direction(Real(b - a));
      factor *= Real(p - r + 1);
    }
    piece.blossom(std::span<const BlossomArgument<Real>>(arguments).first(p), factor, row);
  }
}

/// Computes the weights of the blossom f(x_1, .., x_p) of the piece of a face.
/// @param points  the arguments, ascending; reordered
/// @param row     result, p + 1 weights
template <class T>
void blossom_row(const Knots<T>& knots, Index face, std::span<T> points, std::span<T> row) {
  using Real = typename PieceKnots<T>::Real;
  order_for_span(points, knots.all()[knots.span(face)]);
  std::array<BlossomArgument<Real>, max_degree> arguments;
  for (size_t i = 0; i < points.size(); ++i) arguments[i] = BlossomArgument<Real>::point(Real(points[i]));
  PieceKnots<T>(knots, face)
      .blossom(std::span<const BlossomArgument<Real>>(arguments).first(points.size()), Real(1), row);
}

/// Throws unless `fine` has the domain of `coarse` and all its inner knots, `elevations` times more often.
/// @throws InvalidParameter  another domain, or an inner knot that `fine` lacks; names the knot
template <class T>
void check_finer(const Knots<T>& coarse, const Knots<T>& fine, int elevations = 0) {
  const auto refuse = [](KnotFault fault, Index knot, const T& value, const T& other) {
    refuse_knot(fault, knot, static_cast<double>(value), static_cast<double>(other));
  };
  const Index p = fine.degree();
  if (!(fine.begin() == coarse.begin())) refuse(KnotFault::another_domain, p, fine.begin(), coarse.begin());
  if (!(fine.end() == coarse.end())) refuse(KnotFault::another_domain, fine.num_functions(), fine.end(), coarse.end());
  const std::span<const T> all = coarse.all(), finer = fine.all();
  // The start of a closed spline is an inner knot, unless it is opened there.
  for (Index face = fine.is_closed() ? 0 : 1; face < coarse.num_faces(); ++face) {
    const Index k = coarse.span(face);
    const auto times = [&](std::span<const T> values) {
      const auto [first, last] = std::equal_range(values.begin(), values.end(), all[k]);
      return last - first;
    };
    if (times(finer) < times(all) + elevations) refuse(KnotFault::missing, k, all[k], all[k]);
  }
}

/// Returns the control points over finer knots of the same degree as rows over the functions of the coarser
/// ones.
///
/// Finer knots contain every knot inside the domain at least as often. Knots outside are arbitrary; if they
/// contain the coarser ones too, rows are convex combinations. A closed spline can be opened in this way.
/// @throws InvalidParameter  degrees or domains that differ, a knot that is missing
template <class T>
BandRows<T> refinement_rows(const Knots<T>& coarse, const Knots<T>& fine) {
  check_same_degree(coarse.degree(), fine.degree());
  check_finer(coarse, fine);
  const Index p = fine.degree();
  BandRows<T> rows{.width = p + 1};
  std::array<T, max_degree> points;
  for (Index point = 0; point < fine.num_points(); ++point) {
    const Index j = fine.function(point);
    const Index face = coarse.place(std::max(fine.all()[j], coarse.begin())).face;
    std::copy_n(fine.all().begin() + j + 1, p, points.begin());
    blossom_row(coarse, face, std::span<T>(points).first(p), rows.add(coarse.span(face) - p));
  }
  return rows;
}

/// Returns the control points of the same curve one degree higher as rows over the functions of `coarse`: means
/// of the blossom over the ways to omit one argument.
/// @param fine  knots of one degree more with every knot once more, see `elevated_knots`
/// @throws InvalidParameter  other degrees, another domain, or a missing knot
template <class T>
BandRows<T> elevation_rows(const Knots<T>& coarse, const Knots<T>& fine) {
  check_same_degree(coarse.degree() + 1, fine.degree());
  check_finer(coarse, fine, 1);
  const Index p = coarse.degree();
  BandRows<T> rows{.width = p + 1};
  std::array<T, max_degree> points;
  std::array<T, max_degree + 1> one;
  for (Index point = 0; point < fine.num_points(); ++point) {
    const Index j = fine.function(point);
    const Index face = coarse.place(std::max(fine.all()[j], coarse.begin())).face;
    const std::span<T> row = rows.add(coarse.span(face) - p);
    const std::span<const T> all = fine.all().subspan(j + 1, p + 1);
    for (Index left_out = 0, next; left_out <= p; left_out = next) {
      for (next = left_out; next <= p && all[next] == all[left_out];) ++next;
      std::copy_n(all.begin(), left_out, points.begin());
      std::copy(all.begin() + left_out + 1, all.end(), points.begin() + left_out);
      blossom_row(coarse, face, std::span<T>(points).first(p), std::span<T>(one).first(p + 1));
      for (Index i = 0; i <= p; ++i) row[i] += T(next - left_out) * one[i];
    }
    for (T& weight : row) weight /= T(p + 1);
  }
  return rows;
}

/// Returns the p + 1 Bezier control points of a face ("Bezier extraction") as rows. They depend only on the
/// type of the face.
template <class T>
BandRows<T> bezier_rows(const Knots<T>& knots, Index face) {
  const Index p = knots.degree(), k = knots.span(face);
  BandRows<T> rows{.width = p + 1};
  std::array<T, max_degree> points;
  for (Index i = 0; i <= p; ++i) {
    std::fill_n(points.begin(), p - i, knots.all()[k]);
    std::fill_n(points.begin() + (p - i), i, knots.all()[k + 1]);
    blossom_row(knots, face, std::span<T>(points).first(p), rows.add(k - p));
  }
  return rows;
}

/// True if a place is a knot at which rows up to `order` differ between both sides.
bool sides_differ(const Knots<double>& knots, const KnotPlace<double>& place, int order);

/// Rows of a place over the control points.
struct PointRows {
  std::vector<Index> points;  ///< control points with weight, ascending
  WeightRows weights;         ///< position, then derivatives per unit of the face; a column for each point
  bool sides_differ = false;
};
/// Returns the rows of a place up to `order`.
PointRows point_rows(const Knots<double>& knots, const KnotPlace<double>& place, int order);

/// Returns rows as a matrix over the control points. Columns of the same point of a closed spline are summed;
/// zeros are left out.
SparseMatrix point_matrix(const BandRows<double>& rows, const Knots<double>& knots);

/// Returns the matrix S of finer knots, #points of `fine` x #points of `coarse`.
/// @throws InvalidParameter  see refinement_rows, and elevation_rows if `fine` is of one degree more
SparseMatrix refinement_matrix(const Knots<double>& coarse, const Knots<double>& fine);

/// Returns the knots of a part of the domain, with interpolated ends.
/// @throws InvalidParameter  a part without length
Knots<double> part_knots(const Knots<double>& whole, double first, double last);

/// Returns the control points over the knots of a part as rows over those of the whole.
SparseMatrix part_matrix(const Knots<double>& whole, const Knots<double>& part);

}  // namespace sublimit
