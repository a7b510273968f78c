// SPDX-License-Identifier: Apache-2.0
#pragma once
// Surfaces as polynomials in powers of u and v, which can be composed, and their Bezier nets by the textbook
// formula, for tests of joins of patches.
#include <algorithm>
#include <random>
#include <vector>

#include "sublimit/patches/joins/bezier_piece.h"

namespace sublimit::testing {

/// The polynomial sum a_kl u^k v^l.
template <class T>
struct PowerPolynomial {
  std::vector<std::vector<T>> a{{T(0)}};  // a[k][l]; all rows have the same size

  int degree_u() const { return int(a.size()) - 1; }
  int degree_v() const { return int(a[0].size()) - 1; }
  static PowerPolynomial zero(int degree_u, int degree_v) {
    return {std::vector<std::vector<T>>(size_t(degree_u) + 1, std::vector<T>(size_t(degree_v) + 1, T(0)))};
  }
  static PowerPolynomial constant(const T& c) { return {{{c}}}; }
  /// Returns c0 + cu u + cv v.
  static PowerPolynomial linear(const T& c0, const T& cu, const T& cv) {
    return PowerPolynomial{{{c0, cv}, {cu, T(0)}}}.trimmed();
  }
  /// Returns the polynomial without leading zero coefficients.
  PowerPolynomial trimmed() const {
    PowerPolynomial result = *this;
    const auto is_zero = [](const T& c) { return c == T(0); };
    while (result.a.size() > 1 && std::ranges::all_of(result.a.back(), is_zero)) result.a.pop_back();
    while (result.a[0].size() > 1 &&
           std::ranges::all_of(result.a, [&](const auto& row) { return is_zero(row.back()); }))
      for (auto& row : result.a) row.pop_back();
    return result;
  }
};

template <class T>
PowerPolynomial<T> operator+(const PowerPolynomial<T>& f, const PowerPolynomial<T>& g) {
  auto r = PowerPolynomial<T>::zero(std::max(f.degree_u(), g.degree_u()), std::max(f.degree_v(), g.degree_v()));
  for (const PowerPolynomial<T>* p : {&f, &g})
    for (size_t k = 0; k < p->a.size(); ++k)
      for (size_t l = 0; l < p->a[k].size(); ++l) r.a[k][l] += p->a[k][l];
  return r;
}

template <class T>
PowerPolynomial<T> operator*(const PowerPolynomial<T>& f, const PowerPolynomial<T>& g) {
  auto r = PowerPolynomial<T>::zero(f.degree_u() + g.degree_u(), f.degree_v() + g.degree_v());
  for (size_t k = 0; k < f.a.size(); ++k)
    for (size_t l = 0; l < f.a[k].size(); ++l)
      for (size_t m = 0; m < g.a.size(); ++m)
        for (size_t n = 0; n < g.a[m].size(); ++n) r.a[k + m][l + n] += f.a[k][l] * g.a[m][n];
  return r.trimmed();
}

/// Returns the composition f(u(u, v), v(u, v)).
template <class T>
PowerPolynomial<T> composed(const PowerPolynomial<T>& f, const PowerPolynomial<T>& u, const PowerPolynomial<T>& v) {
  PowerPolynomial<T> sum, u_power = PowerPolynomial<T>::constant(T(1));
  for (size_t k = 0; k < f.a.size(); ++k) {
    PowerPolynomial<T> v_power = u_power;
    for (size_t l = 0; l < f.a[k].size(); ++l) {
      sum = sum + PowerPolynomial<T>::constant(f.a[k][l]) * v_power;
      v_power = v_power * v;
    }
    u_power = u_power * u;
  }
  return sum.trimmed();
}

/// A surface: three coordinates, or four homogeneous ones.
template <class T>
using PowerSurface = std::vector<PowerPolynomial<T>>;

/// Returns the Bezier control points over the unit square, b_ij = sum of C(i,k) C(j,l)/(C(p,k) C(q,l)) a_kl.
template <class T>
BezierPatch<T> bezier_patch(const PowerSurface<T>& surface, const T& length = T(1)) {
  BezierPatch<T> patch;
  for (const PowerPolynomial<T>& f : surface) {
    patch.degree_u = std::max(patch.degree_u, f.degree_u());
    patch.degree_v = std::max(patch.degree_v, f.degree_v());
  }
  patch.coordinates = surface.size() == 4 ? Coordinates::homogeneous : Coordinates::plain;
  patch.length = length;
  const auto choose = [](int n, int k) {
    T c(1);
    for (int i = 0; i < k; ++i) c = c * T(n - i) / T(i + 1);
    return c;
  };
  for (int j = 0; j <= patch.degree_v; ++j)
    for (int i = 0; i <= patch.degree_u; ++i)
      for (const PowerPolynomial<T>& f : surface) {
        T sum(0);
        for (int k = 0; k <= std::min(i, f.degree_u()); ++k)
          for (int l = 0; l <= std::min(j, f.degree_v()); ++l)
            sum += choose(i, k) * choose(j, l) / (choose(patch.degree_u, k) * choose(patch.degree_v, l)) *
                   f.a[size_t(k)][size_t(l)];
        patch.columns.push_back(sum);
      }
  return patch;
}

/// Returns a surface near the plane z = 0 with du = x, dv = y, so that it is regular.
template <class T>
PowerSurface<T> random_power_surface(std::mt19937& random, int degree_u, int degree_v) {
  std::uniform_int_distribution<int> draw(-9, 9);
  PowerSurface<T> surface(3, PowerPolynomial<T>::zero(std::max(degree_u, 1), std::max(degree_v, 1)));
  for (size_t c = 0; c < 3; ++c)
    for (int k = 0; k <= degree_u; ++k)
      for (int l = 0; l <= degree_v; ++l)
        surface[c].a[size_t(k)][size_t(l)] = T(draw(random)) / T(c == 2 ? 16 : 16 * (degree_u + 1) * (degree_v + 1));
  surface[0].a[1][0] += T(1);
  surface[1].a[0][1] += T(1);
  return surface;
}

}  // namespace sublimit::testing
