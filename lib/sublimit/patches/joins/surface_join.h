// SPDX-License-Identifier: Apache-2.0
#pragma once
// Continuity of two tensor-product Bezier patches along an edge, u = 1 of the left one and u = 0 of the right
// one, with the same v. In homogeneous columns, H(u, v) = w (S, 1) of the left and K of the right patch, all
// conditions are that polynomials in v vanish or have one sign, so exact numbers decide them exactly.
// Derivatives are those at the edge, and P = H ^ H_u ^ H_v is the tangent plane: P.x = det(H, H_u, H_v, x), and
// its first three coordinates are w^3 S_u x S_v.
//
//   C^k   A_l w_r - A_r w_l vanishes up to order k in u, for H = (A_l, w_l), K = (A_r, w_r)
//   G^1   P.K_u = 0, and P_l.P_r w_l w_r > 0 (first three coordinates): not folded back
//   G^2   then K_u = a H_u + b H_v + c H and the normal curvatures in this direction agree; all of II then agrees:
//         w_r P.K_uu = w_l (a^2 P.H_uu + 2 a b P.H_uv + b^2 P.H_vv), times the square of a coordinate of P, which makes
//         polynomials of a and b
//
// Plain patches have w = 1; their G^1 determinant is det(S_u, S_v, T_u), of degree 3 n - 1 at most, rational ones have
// 4 n - 1.
// Source: normal curvature across the edge, Pegna, Wolter 1992, "Geometrical criteria to guarantee curvature continuity
// of blend surfaces"; its polynomial form is ours.
#include <algorithm>
#include <array>
#include <cassert>
#include <optional>
#include <span>
#include <type_traits>
#include <vector>

#include "sublimit/patches/joins/bezier_piece.h"
#include "sublimit/patches/joins/edge_deviation.h"
#include "sublimit/patches/joins/join_orders.h"

namespace sublimit {

namespace surface_join_detail {

/// Returns the covector P with P.x = det(a, b, c, x).
template <class T>
LineColumn<T> wedge(const LineColumn<T>& a, const LineColumn<T>& b, const LineColumn<T>& c) {
  LineColumn<T> result;
  for (size_t i = 0; i < 4; ++i) {
    // Minors of the rows but i, expanded along c; the signs are those of the last column of a 4 x 4 determinant.
    const size_t rows[3] = {i == 0 ? 1u : 0u, i <= 1 ? 2u : 1u, i <= 2 ? 3u : 2u};
    const auto minor = [&](size_t j, size_t k) { return a[rows[j]] * b[rows[k]] - a[rows[k]] * b[rows[j]]; };
    const LinePolynomial<T> sum = minor(0, 1) * c[rows[2]] - minor(0, 2) * c[rows[1]] + minor(1, 2) * c[rows[0]];
    result[i] = i % 2 == 0 ? T(-1) * sum : sum;
  }
  return result;
}

template <class T>
LinePolynomial<T> dot(const LineColumn<T>& a, const LineColumn<T>& b, size_t coordinates = 4) {
  LinePolynomial<T> sum;
  for (size_t k = 0; k < coordinates; ++k) sum = sum + a[k] * b[k];
  return sum;
}

template <class T>
LineColumn<T> derivative(const LineColumn<T>& a) {
  return {a[0].derivative(), a[1].derivative(), a[2].derivative(), a[3].derivative()};
}

/// Returns the derivative of order k in u of one of the three coordinates of A_l w_r - A_r w_l.
template <class T>
LinePolynomial<T> difference(const std::vector<LineColumn<T>>& left, const std::vector<LineColumn<T>>& right, int k,
                             size_t coordinate) {
  const std::vector<T> choose = binomials<T>(k);
  LinePolynomial<T> sum;
  for (int i = 0; i <= k; ++i) {
    const auto j = static_cast<size_t>(i), rest = static_cast<size_t>(k - i);
    sum = sum + choose[j] * (left[j][coordinate] * right[rest][3] - right[j][coordinate] * left[rest][3]);
  }
  return sum;
}

/// Throws unless the columns and degrees of a patch are valid.
/// @throws InvalidParameter  names the patch
template <class T>
void check(const BezierPatch<T>& patch, const char* which) {
  check_degree(patch.degree_u);
  check_degree(patch.degree_v);
  const bool rational = patch.coordinates == Coordinates::homogeneous;
  const auto points = (static_cast<size_t>(patch.degree_u) + 1) * (static_cast<size_t>(patch.degree_v) + 1);
  bezier_piece_detail::check_columns(which, patch.columns, points, rational ? 4 : 3, rational, patch.length);
}

/// Returns the order up to which derivatives must agree for two patches to be the same map.
template <class T>
int highest_order(const BezierPatch<T>& left, const BezierPatch<T>& right) {
  const bool rational = left.coordinates == Coordinates::homogeneous || right.coordinates == Coordinates::homogeneous;
  return rational ? left.degree_u + right.degree_u : std::max(left.degree_u, right.degree_u);
}

}  // namespace surface_join_detail

/// Returns the orders of a join by the identities above, without any tolerance. T must be an exact number type.
/// G^k above 2 is not examined by itself, but follows from C^k.
///
/// If normals vanish at an end of the edge (a pole) or at isolated points, the result is about the rest of the
/// edge.
/// @throws InvalidParameter  names the patch: a negative degree, wrong counts, numbers that are not finite,
///                           lengths that are not positive
template <class T>
JoinOrders exact_orders(const BezierPatch<T>& left, const BezierPatch<T>& right) {
  using namespace surface_join_detail;
  check(left, "left patch"), check(right, "right patch");
  const int highest = highest_order(left, right), orders = std::max(highest, 2);
  const std::vector<LineColumn<T>> H = cross_derivatives(left, true, orders),
                                   K = cross_derivatives(right, false, orders);
  JoinOrders result;
  // A denominator without zeros, ends included.
  const auto weight_sign = [](const LinePolynomial<T>& w) {
    const T& first = w.coefficients().front();
    const T& last = w.coefficients().back();
    const LineSign inside = sign_between_ends(w);
    if (first == T(0) || last == T(0)) return 0;
    return inside == LineSign::positive ? 1 : inside == LineSign::negative ? -1 : 0;
  };
  const int weight_signs = weight_sign(H[0][3]) * weight_sign(K[0][3]);
  result.obstacle = JoinObstacle::pole;
  if (weight_signs == 0) return result;

  const auto agree = [&](int k) {
    for (size_t i = 0; i < 3; ++i)
      if (!difference(H, K, k, i).is_zero()) return false;
    return true;
  };
  result.obstacle = JoinObstacle::gap;
  if (!agree(0)) return result;
  result.c = result.g = 0;
  while (result.c < highest && agree(result.c + 1)) ++result.c;
  result.is_same = result.c == highest;

  const LineColumn<T> H_v = derivative(H[0]), K_v = derivative(K[0]);
  const LineColumn<T> P = wedge(H[0], H[1], H_v), of_right = wedge(K[0], K[1], K_v);
  const auto has_normals = [](const LineColumn<T>& plane) {
    return !(plane[0].is_zero() && plane[1].is_zero() && plane[2].is_zero());
  };
  result.obstacle = JoinObstacle::no_tangent;
  if (!has_normals(P) || !has_normals(of_right)) return result;
  result.obstacle = JoinObstacle::angle;
  if (!dot(P, K[1]).is_zero()) return result;
  const LineSign sides = sign_between_ends(T(weight_signs) * dot(P, of_right, 3));
  result.obstacle = sides == LineSign::undecided ? JoinObstacle::undecided : JoinObstacle::folded_back;
  if (sides != LineSign::positive) return result;
  result.g = 1;

  const size_t i = !P[0].is_zero() ? 0 : !P[1].is_zero() ? 1 : 2;
  const LinePolynomial<T>& p = P[i];
  // a p and b p.
  const LinePolynomial<T> a = wedge(H[0], K[1], H_v)[i], b = wedge(H[0], H[1], K[1])[i];
  const LineColumn<T> H_uv = derivative(H[1]), H_vv = derivative(H_v);
  const LinePolynomial<T> of_left = a * a * dot(P, H[2]) + T(2) * (a * b * dot(P, H_uv)) + b * b * dot(P, H_vv);
  result.obstacle = JoinObstacle::curvature;
  if (!(K[0][3] * (p * p * dot(P, K[2])) - H[0][3] * of_left).is_zero()) return result;
  result.g = std::max(2, result.c);  // with normals C^k is G^k
  result.obstacle = JoinObstacle::none;
  return result;
}

/// Result of `rounded_order`.
struct RoundedOrder {
  int c = -1;            ///< largest k of C^k; -1 for a gap
  bool is_same = false;  ///< true if all derivatives that can differ agree
};
/// Returns C^k in floating-point numbers: coefficients of the same polynomials are compared with the size of
/// their terms.
RoundedOrder rounded_order(BezierPatch<double> left, BezierPatch<double> right, double tolerance);

/// Result of comparing two patches.
struct SurfaceJoin {
  JoinOrders measured;
  std::optional<JoinOrders> exact{};  ///< set for exact numbers
  EdgeDeviation deviation{};          ///< measured deviations; the parameter s of places is v
};

/// Returns how the edge u = 1 of `left` and the edge u = 0 of `right` meet, measured by samples (see
/// measured_deviation), and for exact numbers also decided exactly.
/// @throws InvalidParameter  see exact_orders
SurfaceJoin surface_join(const BezierPatch<double>& left, const BezierPatch<double>& right,
                         const JoinTolerance& tolerance = {});

/// Returns the join of two patches with exact numbers (fractions) as coefficients.
template <class T>
SurfaceJoin surface_join(const BezierPatch<T>& left, const BezierPatch<T>& right, const JoinTolerance& tolerance = {}) {
  static_assert(!std::is_floating_point_v<T>);
  const JoinOrders exact = exact_orders(left, right);
  const auto rounded = [](const BezierPatch<T>& patch) {
    BezierPatch<double> result{.degree_u = patch.degree_u,
                               .degree_v = patch.degree_v,
                               .columns = {},
                               .coordinates = patch.coordinates,
                               .length = static_cast<double>(patch.length)};
    for (const T& x : patch.columns) result.columns.push_back(static_cast<double>(x));
    return result;
  };
  SurfaceJoin result = surface_join(rounded(left), rounded(right), tolerance);
  result.exact = exact;
  return result;
}

}  // namespace sublimit
