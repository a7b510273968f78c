// SPDX-License-Identifier: Apache-2.0
#pragma once
// Merrien 1992, "A family of Hermite interpolants by bisection algorithms": unknowns are points and derivatives, and a
// edge's middle gets both from the two at its ends,
//
//   f(m)  = (f(a) + f(b))/2 + alpha h (f'(b) - f'(a))
//   f'(m) = (1 - beta) (f(b) - f(a))/h + beta (f'(a) + f'(b))/2.
//
// alpha = -1/8 with beta = -1/2 is the cubic Hermite interpolant, with beta = -1 the C^1 quadratic one with a knot in
// the middle. Derivatives are kept per edge of their level (h = 1), so that the rules are the same at every level.
#include <algorithm>
#include <array>
#include <cmath>

#include "sublimit/base/error.h"
#include "sublimit/curves/curve_scheme.h"

namespace sublimit {

/// True if the limits of Merrien's scheme are C^1, proved by norms.
///
/// On an edge let u, v be the derivatives at its ends less the slope of its chord. Bisection maps (u, v) linearly to
/// those of either half, and the limit is C^1 if products of these two maps shrink: if all products of some length have
/// maximum norms below one.
inline bool merrien_is_smooth(double alpha, double beta) {
  using Map = std::array<double, 4>;  // rows (u', v') of columns (u, v)
  const double a = 2 * alpha, b = beta / 2;
  const Map halves[] = {{1 + a, -a, b + a, b - a}, {b - a, b + a, -a, 1 + a}};
  std::vector<Map> products{{1, 0, 0, 1}};
  constexpr int longest = 14;
  for (int length = 1; length <= longest; ++length) {
    std::vector<Map> longer;
    double norm = 0;
    for (const Map& p : products)
      for (const Map& m : halves) {
        longer.push_back({m[0] * p[0] + m[1] * p[2], m[0] * p[1] + m[1] * p[3], m[2] * p[0] + m[3] * p[2],
                          m[2] * p[1] + m[3] * p[3]});
        const Map& q = longer.back();
        norm = std::max({norm, std::abs(q[0]) + std::abs(q[1]), std::abs(q[2]) + std::abs(q[3])});
      }
    if (norm < 1) return true;
    products.swap(longer);
  }
  return false;
}

template <class T>
CurveScheme<T> hermite_merrien(const SchemeOptions& options) {
  const OptionInfo alpha{.name = "alpha",
                         .values = {"-1/8"},
                         .meaning =
                             "pull of the derivatives on the middle; -1/8 reproduces quadratics, and cubics with "
                             "beta=-1/2",
                         .range = OptionRange{{-1, 2}, {0, 1}}};
  const OptionInfo beta{
      .name = "beta",
      .values = {"-1/2"},
      .meaning = "share of the ends' derivatives in the middle's, which has 1 - beta of the chord's slope",
      .range = OptionRange{{-3, 1}, {1, 1}}};
  const Ratio a = ratio_option(options, alpha), b = ratio_option(options, beta);
  if (!merrien_is_smooth(a.value(), b.value()))
    throw InvalidOption("option alpha=" + to_string(a) + " with beta=" + to_string(b) +
                        ": products of up to 14 steps do not prove the limit C^1; with alpha=-1/8 they do for beta "
                        "from -2.7 to 0.99");
  const bool quadratics = 8 * a.p == -a.q, cubics = quadratics && 2 * b.p == -b.q;
  return {.name = "hermite-merrien",
          .source = "Merrien 1992, A family of Hermite interpolants by bisection algorithms",
          .masks = {.point = [](const CurveSite<T>& p) { return p.point(0); },
                    .edge =
                        [a](const CurveSite<T>& p) {
                          return (p.point(0) + p.point(1)) / 2 +
                                 p.ratio(a.p, a.q) * (p.derivative(1) - p.derivative(0));
                        },
                    .point_derivative = [](const CurveSite<T>& p) { return p.derivative(0) / 2; },
                    .edge_derivative =
                        [b](const CurveSite<T>& p) {  // per edge of the child, which is half as long
                          const T share = p.ratio(b.p, b.q);
                          return (1 - share) / 2 * (p.point(1) - p.point(0)) +
                                 share / 4 * (p.derivative(0) + p.derivative(1));
                        }},
          .claims = {.regular = 1,
                     .generates = cubics       ? 3
                                  : quadratics ? 2
                                               : 1,
                     .reproduces = cubics       ? 3
                                   : quadratics ? 2
                                                : 1,
                     .interpolates = true,
                     .limit = cubics                      ? "cubic Hermite spline"
                              : quadratics && b.p == -b.q ? "quadratic spline"
                                                          : "no polynomial pieces",
                     .exponent = cubics ? "2" : "at least 1"},
          .options = {alpha, beta}};
}

}  // namespace sublimit
