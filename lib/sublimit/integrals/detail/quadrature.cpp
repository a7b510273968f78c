// SPDX-License-Identifier: Apache-2.0
#include "sublimit/integrals/detail/quadrature.h"

#include <cmath>
#include <numbers>
#include <utility>

namespace sublimit {
namespace {

/// Legendre's polynomial of degree n and its derivative.
std::pair<double, double> legendre(int n, double x) {
  double p = 1, before = 0;
  for (int k = 1; k <= n; ++k) before = std::exchange(p, ((2 * k - 1) * x * p - (k - 1) * before) / k);
  return {p, n * (x * p - before) / (x * x - 1)};
}

/// On [0, 1]: u and weight.
std::vector<QuadraturePoint> line_rule(int n) {
  std::vector<QuadraturePoint> rule;
  for (int i = n; i >= 1; --i) {
    double x = std::cos(std::numbers::pi * (i - 0.25) / (n + 0.5));
    for (int step = 0; step < 6; ++step) {  // Newton's method from there needs four
      const auto [p, dp] = legendre(n, x);
      x -= p / dp;
    }
    const double dp = legendre(n, x).second;
    rule.push_back({(1 + x) / 2, 0, 1 / ((1 - x * x) * dp * dp)});
  }
  return rule;
}

}  // namespace

std::vector<QuadraturePoint> square_rule(int n) {
  const std::vector<QuadraturePoint> line = line_rule(n);
  std::vector<QuadraturePoint> rule;
  for (const QuadraturePoint& b : line)
    for (const QuadraturePoint& a : line) rule.push_back({a.u, b.u, a.weight * b.weight});
  return rule;
}

std::vector<QuadraturePoint> triangle_rule(int n) {
  std::vector<QuadraturePoint> rule = square_rule(n);
  for (QuadraturePoint& p : rule) {
    p.weight *= 1 - p.u;
    p.v *= 1 - p.u;
  }
  return rule;
}

}  // namespace sublimit
