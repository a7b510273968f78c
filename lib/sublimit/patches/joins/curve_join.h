// SPDX-License-Identifier: Apache-2.0
#pragma once
// Continuity of two Bezier curves where the end of one meets the start of the other. They may be polynomial or
// rational, over intervals of any length. C^k compares derivatives p^(k), q^(k) per unit of the given
// parameters; G^k finds the derivatives b_1, b_2, .. of a change of parameters with
//
//   q' = b_1 p',  q'' = b_1^2 p'' + b_2 p',  q''' = b_1^3 p''' + 3 b_1 b_2 p'' + b_3 p',  ..     b_1 > 0
//
// one after the other: each is a quotient of derivatives, so exact numbers decide exactly.
// Source: Barsky, DeRose 1984, "Geometric continuity of parametric curves"; the case of vanishing
// derivatives is ours.
#include <algorithm>
#include <cmath>
#include <optional>
#include <type_traits>
#include <vector>

#include "sublimit/patches/joins/bezier_piece.h"
#include "sublimit/patches/joins/join_orders.h"

namespace sublimit {

/// Result of comparing two curves.
struct CurveJoin {
  JoinOrders orders;
  std::vector<double> point;  ///< end of the left curve; empty at a pole
  double gap = 0;             ///< distance from the end of the left curve to the start of the right one
  /// Angle between the tangents, radians. At zero speed tangents are the first derivatives that do not vanish.
  /// Nothing if a curve is a single point.
  std::optional<double> angle{};
  /// Curvature vectors (x'' - (x''.T) T)/|x'|^2, and their distance; empty at zero speed.
  std::vector<double> left_curvature{}, right_curvature{};
  std::optional<double> curvature_jump{};
  std::vector<double> ratios{};  ///< b_1 .. b_g; b_1 < 0 alone if folded back; empty at zero speed
};

namespace curve_join_detail {

double length(const std::vector<double>& a);
double angle(const std::vector<double>& a, const std::vector<double>& b);
std::vector<double> curvature(const std::vector<double>& first, const std::vector<double>& second);
double distance(const std::vector<double>& a, const std::vector<double>& b);

template <class T>
T dot(const std::vector<T>& a, const std::vector<T>& b) {
  T sum(0);
  for (size_t k = 0; k < a.size(); ++k) sum += a[k] * b[k];
  return sum;
}
template <class T>
std::vector<double> in_doubles(const std::vector<T>& a) {
  std::vector<double> result;
  for (const T& x : a) result.push_back(static_cast<double>(x));
  return result;
}

/// Returns a - factor b.
template <class T>
std::vector<T> minus(std::vector<T> a, const T& factor, const std::vector<T>& b) {
  for (size_t k = 0; k < a.size(); ++k) a[k] -= factor * b[k];
  return a;
}

/// Derivatives at an end by order, relative to a point.
template <class T>
struct EndJet {
  bool is_pole = false;
  std::vector<std::vector<T>> derivatives{};
  std::vector<double> sizes{};  ///< sizes that they would have if no terms cancelled
};

/// Returns the derivatives at an end of a curve.
/// @param columns  homogeneous columns, relative to a point near the end
template <class T>
EndJet<T> end_jet(const std::vector<T>& columns, int degree, int dimension, bool at_end, int orders, const T& length) {
  const int width = dimension + 1;
  const std::vector<T> rows = bezier_piece_detail::end_rows(degree, at_end, orders, length);
  const auto column = [&](int i) { return columns.begin() + i * width; };
  EndJet<T> result;
  const T w = column(at_end ? degree : 0)[dimension];
  if ((result.is_pole = w == T(0))) return result;
  double reach = 0;
  std::vector<T> weight_derivatives;
  std::vector<double> weight_sizes;
  for (int i = 0; i <= degree; ++i)
    reach = std::max(reach, curve_join_detail::length(in_doubles(std::vector<T>(column(i), column(i) + dimension))));
  const double w_size = std::abs(static_cast<double>(w));
  for (int r = 0; r <= orders; ++r) {
    std::vector<T> value(static_cast<size_t>(dimension), T(0));
    T weight(0);
    double size = 0, weight_size = 0;
    for (int i = 0; i <= degree; ++i) {
      const T& row = rows[static_cast<size_t>(r * (degree + 1) + i)];
      if (row == T(0)) continue;
      for (int k = 0; k < dimension; ++k) value[static_cast<size_t>(k)] += row * column(i)[k];
      weight += row * column(i)[dimension];
      size += std::abs(static_cast<double>(row)) * reach;
      weight_size += std::abs(static_cast<double>(row) * static_cast<double>(column(i)[dimension]));
    }
    // The quotient rule: (w x)^(r) = sum over i of C(r, i) w^(i) x^(r-i).
    const std::vector<T> choose = binomials<T>(r);
    weight_derivatives.push_back(weight), weight_sizes.push_back(weight_size);
    for (int i = 1; i <= r; ++i) {
      const T factor = choose[static_cast<size_t>(i)] * weight_derivatives[static_cast<size_t>(i)];
      if (factor == T(0)) continue;
      value = minus(std::move(value), factor, result.derivatives[static_cast<size_t>(r - i)]);
      size += static_cast<double>(choose[static_cast<size_t>(i)]) * weight_sizes[static_cast<size_t>(i)] *
              result.sizes[static_cast<size_t>(r - i)];
    }
    for (T& x : value) x /= w;
    result.derivatives.push_back(std::move(value));
    result.sizes.push_back(size / w_size);
  }
  return result;
}

/// Returns the coefficients of t^0 .. t^n of (b_1 t + b_2 t^2 + ..)^m.
template <class T>
std::vector<T> power_of_series(const std::vector<T>& b, int m, int n) {
  std::vector<T> result(static_cast<size_t>(n) + 1, T(0));
  result[0] = T(1);
  for (int i = 0; i < m; ++i) {
    std::vector<T> next(result.size(), T(0));
    for (size_t j = 0; j < result.size(); ++j)
      for (size_t k = 1; k < b.size() && j + k < next.size(); ++k) next[j + k] += result[j] * b[k];
    result = std::move(next);
  }
  return result;
}

/// Returns homogeneous columns of a piece, relative to a point.
template <class T>
std::vector<T> seen_from(const std::vector<T>& origin, const BezierPiece<T>& piece) {
  const size_t dimension = origin.size(), rational = piece.coordinates == Coordinates::homogeneous ? 1 : 0;
  std::vector<T> result;
  for (size_t at = 0; at < piece.columns.size(); at += dimension + rational) {
    const T w = rational ? piece.columns[at + dimension] : T(1);
    for (size_t k = 0; k < dimension; ++k) result.push_back(piece.columns[at + k] - w * origin[k]);
    result.push_back(w);
  }
  return result;
}

}  // namespace curve_join_detail

/// Returns how the end of `left` and the start of `right` meet.
///
/// With exact numbers (fractions) the orders are exact, without any tolerance. With floating-point numbers
/// terms are compared with their own size. At zero speed the tangent is the first derivative that does not
/// vanish, with the sign of the direction in which the curve arrives or leaves; if both tangents agree the join
/// is G^1, and higher orders are not decided (`no_speed`). Orders are examined up to the larger degree of two
/// polynomials (G at least up to 3), or up to the sum of the degrees if one curve is rational: if all these
/// derivatives agree, the curves are the same.
/// @param tolerance  for floating-point numbers; `curvature` is not used
/// @throws InvalidParameter  names the piece: a negative degree, wrong counts, numbers that are not finite,
///                           lengths that are not positive, points of different dimensions
template <class T>
CurveJoin curve_join(const BezierPiece<T>& left, const BezierPiece<T>& right, const JoinTolerance& tolerance = {}) {
  using namespace curve_join_detail;
  constexpr bool is_exact = !std::is_floating_point_v<T>;
  const auto dimension_of = [](const BezierPiece<T>& piece, const char* which) {
    check_degree(piece.degree);
    const bool rational = piece.coordinates == Coordinates::homogeneous;
    return bezier_piece_detail::check_columns(which, piece.columns, static_cast<size_t>(piece.degree) + 1, 0, rational,
                                              piece.length) -
           (rational ? 1 : 0);
  };
  const int dimension = dimension_of(left, "left curve"), of_right = dimension_of(right, "right curve");
  if (dimension != of_right) bezier_piece_detail::refuse_dimensions(dimension, of_right);
  const bool rational = left.coordinates == Coordinates::homogeneous || right.coordinates == Coordinates::homogeneous;
  const int highest_c = rational ? left.degree + right.degree : std::max(left.degree, right.degree);
  const int highest_g = std::max(highest_c, 3);

  CurveJoin join;
  std::vector<T> origin(left.columns.end() - dimension, left.columns.end());
  if (left.coordinates == Coordinates::homogeneous) {
    origin.assign(left.columns.end() - dimension - 1, left.columns.end() - 1);
    if (left.columns.back() == T(0)) {
      join.orders.obstacle = JoinObstacle::pole;
      return join;
    }
    for (T& x : origin) x /= left.columns.back();
  }
  const EndJet<T> l = end_jet(seen_from(origin, left), left.degree, dimension, true, highest_g, left.length);
  const EndJet<T> r = end_jet(seen_from(origin, right), right.degree, dimension, false, highest_g, right.length);
  if (r.is_pole) {
    join.orders.obstacle = JoinObstacle::pole;
    return join;
  }
  const auto vanishes = [&](const std::vector<T>& difference, double size) {
    if constexpr (is_exact)
      return std::all_of(difference.begin(), difference.end(), [](const T& x) { return x == T(0); });
    else
      return length(in_doubles(difference)) <= tolerance.distance * size;
  };
  const auto size = [&](int k) { return std::max(l.sizes[static_cast<size_t>(k)], r.sizes[static_cast<size_t>(k)]); };
  const auto of_left = [&](int k) -> const std::vector<T>& { return l.derivatives[static_cast<size_t>(k)]; };
  const auto of = [&](int k) -> const std::vector<T>& { return r.derivatives[static_cast<size_t>(k)]; };

  join.point = in_doubles(origin);
  join.gap = distance(in_doubles(of_left(0)), in_doubles(of(0)));
  if (!vanishes(minus(of(0), T(1), of_left(0)), size(0))) return join;
  JoinOrders& orders = join.orders;
  orders.c = orders.g = 0;
  while (orders.c < highest_c && vanishes(minus(of(orders.c + 1), T(1), of_left(orders.c + 1)), size(orders.c + 1)))
    ++orders.c;
  orders.is_same = orders.c == highest_c;

  // Tangents: the first derivatives that do not vanish. Before its end the left curve is at (-t)^k x^(k)/k!.
  const auto first_order = [&](const EndJet<T>& jet) {
    for (int k = 1; k <= highest_g; ++k)
      if (!vanishes(jet.derivatives[static_cast<size_t>(k)], jet.sizes[static_cast<size_t>(k)])) return k;
    return 0;
  };
  const int left_order = first_order(l), right_order = first_order(r);
  orders.obstacle = JoinObstacle::no_tangent;
  if (left_order == 0 || right_order == 0) return join;
  std::vector<T> arriving = of_left(left_order);
  if (left_order % 2 == 0)
    for (T& x : arriving) x = -x;
  const std::vector<T>& leaving = of(right_order);
  join.angle = angle(in_doubles(arriving), in_doubles(leaving));
  if (left_order == 1 && right_order == 1) {
    join.left_curvature = curvature(in_doubles(of_left(1)), in_doubles(of_left(2)));
    join.right_curvature = curvature(in_doubles(of(1)), in_doubles(of(2)));
    join.curvature_jump = distance(join.left_curvature, join.right_curvature);
  }
  const T ratio = dot(leaving, arriving) / dot(arriving, arriving);
  const auto is_along = [&] {
    if constexpr (is_exact) return vanishes(minus(leaving, ratio, arriving), 0);
    return std::min(*join.angle, std::acos(-1.0) - *join.angle) <= tolerance.angle;
  };
  orders.obstacle = JoinObstacle::angle;
  if (!is_along()) return join;
  const bool has_speed = left_order == 1 && right_order == 1;
  if (has_speed) join.ratios.push_back(static_cast<double>(ratio));
  orders.obstacle = JoinObstacle::folded_back;
  if (!(T(0) < ratio)) return join;
  orders.g = 1;
  orders.obstacle = JoinObstacle::no_speed;
  if (!has_speed) return join;

  // With Taylor coefficients the derivatives of the change are those of a power series, b_n = (n-th derivative)/n!.
  std::vector<T> b{T(0), ratio};
  T factorial(1);  // n!
  std::vector<T> inverse_factorials{T(1), T(1)};
  for (int n = 2; n <= highest_g; ++n) {
    factorial *= T(n);
    inverse_factorials.push_back(T(1) / factorial);
    std::vector<T> rest = minus(of(n), T(0), of(n));
    for (T& x : rest) x *= inverse_factorials.back();
    double terms = r.sizes[static_cast<size_t>(n)] * static_cast<double>(inverse_factorials.back());
    for (int m = 2; m <= n; ++m) {
      const T factor = power_of_series(b, m, n).back() * inverse_factorials[static_cast<size_t>(m)];
      rest = minus(std::move(rest), factor, of_left(m));
      terms += std::abs(static_cast<double>(factor)) * l.sizes[static_cast<size_t>(m)];
    }
    const T next = dot(rest, of_left(1)) / dot(of_left(1), of_left(1));
    orders.obstacle = JoinObstacle::curvature;
    if (!vanishes(minus(std::move(rest), next, of_left(1)), terms)) return join;
    b.push_back(next);
    join.ratios.push_back(static_cast<double>(T(next * factorial)));
    orders.g = n;
  }
  orders.obstacle = JoinObstacle::none;
  return join;
}

}  // namespace sublimit
