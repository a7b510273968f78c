// SPDX-License-Identifier: Apache-2.0
#include "sublimit/patches/constructions/lagrange_curve.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

#include "sublimit/core/detail/binomial.h"
#include "sublimit/patches/constructions/polynomial_curves.h"
#include "sublimit/patches/detail/spline_rows.h"
#include "sublimit/source/detail/derivative_order.h"

namespace sublimit {

CurvePlace LagrangeCurve::place(double t, KnotSide) const {
  basis_.check_inside(t);
  return {.segment = 0, .t = std::clamp(basis_.unit(t), 0., 1.)};  // the last node may be one rounding beyond
}

CurveStencil LagrangeCurve::stencil(const CurvePlace& place, int order) const {
  check_order(order);
  check_place(place, 1);
  CurveStencil result{.status = LimitStatus::regular, .unknowns = {}, .weights = basis_.rows(place.t, order)};
  result.unknowns.resize(static_cast<size_t>(num_points()));
  std::iota(result.unknowns.begin(), result.unknowns.end(), 0);
  return result;
}

// The j-th derivative at an end, D^j by barycentric rows, gives the j-th difference there; from both ends, half of them
// each, the points are sums of few terms.
std::optional<Points> lagrange_to_bezier(const LagrangeBasis& basis) {
  const Index n = basis.size() - 1;
  if (n > max_degree) return std::nullopt;
  Points points = Points::Zero(n + 1, n + 1);
  const auto ends = [&](bool right) {
    // Differences Delta^j b at the end: derivative times (n-j)!/n!.
    const WeightRows rows = basis.rows(right ? 1 : 0, n);
    Points differences = rows;
    double factor = 1;
    for (Index j = 1; j <= n; ++j) {
      factor /= n - j + 1;
      differences.row(j) *= factor;
    }
    return differences;
  };
  const Points left = ends(false), right = ends(true);
  for (Index i = 0; i <= n; ++i) {
    const bool from_left = 2 * i <= n;
    const std::vector<double> choose = binomials<double>(from_left ? i : n - i);
    for (Index j = 0; j < std::ssize(choose); ++j)
      if (from_left)
        points.row(i) += choose[size_t(j)] * left.row(j);
      else
        points.row(i) += (j % 2 == 0 ? choose[size_t(j)] : -choose[size_t(j)]) * right.row(j);
  }
  // What rows of the Bezier form give for the basis polynomials, between nodes and at them.
  const Knots<double> knots = bezier_knots<double>(n);
  Eigen::RowVectorXd row(n + 1);
  for (int s = 0; s <= 4 * n; ++s) {
    const double u = double(s) / (4 * n);
    span_rows<double>(knots, 0, u, 0, std::span<double>(row.data(), size_t(n) + 1));
    const Eigen::RowVectorXd wrong = row * points - basis.rows(u, 0).row(0);
    if (!(wrong.cwiseAbs().sum() <= lagrange_net_accuracy)) return std::nullopt;
  }
  return points;
}

namespace {

Knots<double> knots_of(const LagrangeBasis& basis) {
  return bezier_curve(Points::Zero(basis.size(), 1), basis.begin(), basis.end()).knots;
}

}  // namespace

std::optional<CurveNet> lagrange_net(const LagrangeBasis& basis, const Points& points) {
  const std::optional<Points> M = lagrange_to_bezier(basis);
  if (!M) return std::nullopt;
  return CurveNet{knots_of(basis), *M * points};
}

std::optional<SplineNet> lagrange_net(const LagrangeBasis& u, const LagrangeBasis& v, const Points& points) {
  const std::optional<Points> in_u = lagrange_to_bezier(u), in_v = lagrange_to_bezier(v);
  if (!in_u || !in_v) return std::nullopt;
  const SparseMatrix M = kronecker(in_v->sparseView(), in_u->sparseView());
  return spline_net(knots_of(u), knots_of(v), M * points);
}

}  // namespace sublimit
