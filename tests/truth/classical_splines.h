// SPDX-License-Identifier: Apache-2.0
#pragma once
// Textbook algorithms for B-splines, independent of the library, which uses blossoms: references for its tests.
// Knots are t_0 .. t_{n+p}; k is the span [t_k, t_{k+1}] of a piece.
#include <random>
#include <span>
#include <vector>

#include "sublimit/patches/knots.h"

namespace sublimit::testing {

/// Returns N_i of degree q by the recursion of Cox and de Boor (1972), 0/0 = 0.
template <class T>
T cox_de_boor(std::span<const T> t, Index k, Index i, Index q, const T& x) {
  if (i > k || i + q < k) return T(0);
  if (q == 0) return T(1);
  T sum(0);
  if (t[i] < t[i + q]) sum += (x - t[i]) / (t[i + q] - t[i]) * cox_de_boor(t, k, i, q - 1, x);
  if (t[i + 1] < t[i + q + 1])
    sum += (t[i + q + 1] - x) / (t[i + q + 1] - t[i + 1]) * cox_de_boor(t, k, i + 1, q - 1, x);
  return sum;
}

/// Returns the point of a piece from its control points P_{k-p} .. P_k, by de Boor's corner cutting (1972).
template <class T>
T de_boor(std::span<const T> t, Index k, std::vector<T> points, const T& x) {
  const Index p = static_cast<Index>(points.size()) - 1;
  for (Index r = 1; r <= p; ++r)
    for (Index j = p; j >= r; --j) {
      const T &low = t[k - p + j], &high = t[k + 1 + j - r];
      const T a = (x - low) / (high - low);
      points[j] = (T(1) - a) * points[j - 1] + a * points[j];
    }
  return points[p];
}

/// Returns the control points after insertion of a knot s in [t_k, t_{k+1}) (Boehm 1980).
template <class T>
std::vector<T> boehm(std::span<const T> t, Index p, Index k, const std::vector<T>& points, const T& s) {
  std::vector<T> result;
  for (Index i = 0; i <= std::ssize(points); ++i) {
    const T a = i <= k - p ? T(1) : i > k ? T(0) : T((s - t[i]) / (t[i + p] - t[i]));
    T q(0);
    if (!(a == T(0))) q += a * points[i];
    if (!(a == T(1))) q += (T(1) - a) * points[i - 1];
    result.push_back(q);
  }
  return result;
}

/// Returns the discrete B-spline alpha_i of degree r at tau_j (Cohen, Lyche, Riesenfeld 1980), 0/0 = 0.
template <class T>
T oslo(std::span<const T> t, std::span<const T> tau, Index i, Index r, Index j) {
  if (i < 0 || i + r + 1 >= std::ssize(t)) return T(0);
  if (r == 0) return T(t[i] <= tau[j] && tau[j] < t[i + 1] ? 1 : 0);
  T sum(0);
  if (t[i] < t[i + r]) sum += (tau[j + r] - t[i]) / (t[i + r] - t[i]) * oslo(t, tau, i, r - 1, j);
  if (t[i + 1] < t[i + r + 1])
    sum += (t[i + r + 1] - tau[j + r]) / (t[i + r + 1] - t[i + 1]) * oslo(t, tau, i + 1, r - 1, j);
  return sum;
}

/// Returns the row of a derivative by differences of control points: D_i = p (P_{i+1} - P_i) / (t_{i+p+1} -
/// t_{i+1}), or 0 if the denominator is 0; a curve over the knots without the first and the last one.
template <class T>
std::vector<T> hodograph_row(std::span<const T> t, Index p, Index k, int order, const T& x) {
  const Index n = static_cast<Index>(t.size()) - p - 1;
  if (order == 0) {
    std::vector<T> row;
    for (Index i = 0; i < n; ++i) row.push_back(cox_de_boor(t, k, i, p, x));
    return row;
  }
  std::vector<T> row(n, T(0));
  if (p == 0) return row;
  const std::vector<T> lower = hodograph_row(t.subspan(1, t.size() - 2), p - 1, k - 1, order - 1, x);
  for (Index i = 0; i + 1 < n; ++i) {
    if (!(t[i + 1] < t[i + p + 1])) continue;
    const T slope = lower[i] * T(p) / (t[i + p + 1] - t[i + 1]);
    row[i] -= slope;
    row[i + 1] += slope;
  }
  return row;
}

/// Returns points with random coordinates from -1 to 1.
inline Points random_points(std::mt19937& random, Index rows, Index columns) {
  std::uniform_real_distribution<double> coordinate(-1, 1);
  return Points::NullaryExpr(rows, columns, [&] { return coordinate(random); });
}

/// Returns random knots with distances that are multiples of 1/8 up to 2. All multiplicities up to degree + 1
/// occur, at ends and inside; closed ones have any number of points.
template <class T>
Knots<T> random_knots(std::mt19937& random, int degree, bool is_closed = false) {
  const auto draw = [&](int least, int most) { return std::uniform_int_distribution<int>(least, most)(random); };
  const int most = draw(1, degree + 1);
  const int count = is_closed ? draw(2, degree + 6) : 2 * degree + 2 + draw(0, 12);
  std::vector<T> knots;
  T t = T(draw(-16, 16)) / T(8);
  while (static_cast<int>(knots.size()) < count) {
    const int times = std::min(draw(1, most), count - static_cast<int>(knots.size()));
    knots.insert(knots.end(), static_cast<size_t>(times), t);
    t += T(draw(1, 16)) / T(8);
  }
  if (!(knots.front() < knots.back())) return random_knots<T>(random, degree, is_closed);
  if (is_closed) {
    // Its ends are one knot, equal ones on both sides together no more than degree + 1.
    if (knots[count - 2] == knots[count - 1]) knots.back() += T(1) / T(8);
    return Knots<T>::closed(degree, knots);
  }
  if (!(knots[degree] < knots[count - degree - 1])) return random_knots<T>(random, degree, is_closed);
  return Knots<T>::open(degree, count - degree - 1, knots);
}

}  // namespace sublimit::testing
