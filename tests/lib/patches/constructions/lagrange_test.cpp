// SPDX-License-Identifier: Apache-2.0
// Lagrange interpolation in barycentric form, of curves and of grids.
#include "sublimit/patches/constructions/lagrange_curve.h"

#include <gtest/gtest.h>

#include <cmath>

#include "meshes/construction_data.h"
#include "sublimit/patches/constructions/lagrange_surface.h"
#include "support/expect_error.h"

namespace sublimit::testing {
namespace {

/// l_i and derivatives in 256 bits, by the product rule.
Precise lagrange(const std::vector<double>& nodes, size_t i, double x, int order, std::vector<size_t> left_out = {}) {
  left_out.push_back(i);
  if (order > 0) {
    Precise sum = 0;
    for (size_t k = 0; k < nodes.size(); ++k)
      if (std::ranges::find(left_out, k) == left_out.end()) {
        std::vector<size_t> more(left_out.begin(), left_out.end() - 1);
        more.push_back(k);
        // the factor (x - x_k) goes, its slope 1 / (x_i - x_k) stays
        sum += lagrange(nodes, i, x, order - 1, more) / (Precise(nodes[i]) - nodes[k]);
      }
    return sum;
  }
  Precise product = 1;
  for (size_t k = 0; k < nodes.size(); ++k)
    if (k != i && std::ranges::find(left_out, k) == left_out.end())
      product *= (Precise(x) - nodes[k]) / (Precise(nodes[i]) - nodes[k]);
  return product;
}

TEST(LagrangeBasis, IsTheProductFormula) {
  std::mt19937 random(1);
  for (const std::vector<double>& nodes :
       {std::vector<double>{0, 1}, {0, 0.5, 2}, {3, 1, 2, 0.25, -1}, {0, 1, 2, 3, 4, 5, 6, 7, 8}}) {
    const LagrangeBasis basis(nodes);
    for (const double u : {0.0, 0.1, 1.0 / 3, 0.5, 0.5000000001, 0.77, 1.0}) {
      const WeightRows rows = basis.rows(u, 2);
      const double x = basis.begin() + u * basis.length();
      for (int r = 0; r <= 2; ++r)
        for (size_t i = 0; i < nodes.size(); ++i)
          EXPECT_NEAR(rows(r, Index(i)), double(lagrange(nodes, i, x, r)) * std::pow(basis.length(), r),
                      r == 0 ? 100 * sums : 100 * derivative_sums);
      EXPECT_NEAR(rows.row(0).sum(), 1, sums);
      EXPECT_NEAR(rows.row(1).sum(), 0, derivative_sums);
    }
  }
}

TEST(LagrangeBasis, IsExactAtNodes) {
  const std::vector<double> nodes{0.1, 0.7, 0.3, 1.9};
  const LagrangeBasis basis(nodes);
  for (size_t i = 0; i < nodes.size(); ++i) {
    const WeightRows row = basis.rows(basis.unit(nodes[i]), 0);
    for (Index j = 0; j < 4; ++j) EXPECT_EQ(row(0, j), j == Index(i) ? 1 : 0);
  }
}

TEST(LagrangeBasis, MagnifiesErrorsAtHighDegrees) {
  for (const auto& [degree, constant] :
       std::initializer_list<std::pair<int, double>>{{5, 3.1}, {10, 29}, {15, 510}, {20, 11000}}) {
    std::vector<double> nodes;
    for (int i = 0; i <= degree; ++i) nodes.push_back(i);
    const LagrangeBasis basis(nodes);
    double most = 0;
    for (int s = 0; s <= 5000; ++s) most = std::max(most, basis.rows(s / 5000.0, 0).cwiseAbs().sum());
    constexpr double two_digits = 0.04;  // the constants are given with so many
    EXPECT_NEAR(most / constant, 1, two_digits) << degree;
  }
}

TEST(LagrangeBasis, NamesNodes) {
  expect_error<InvalidParameter>([] { LagrangeBasis({0, 1, 2, 1}); }, {"nodes 1 and 3 are both 1"});
  expect_error<InvalidParameter>([] { LagrangeBasis({0}); }, {"1 nodes", "2 at least"});
  expect_error<InvalidParameter>([] { LagrangeBasis({0, std::nan("")}); }, {"node 1 is nan"});
}

TEST(LagrangeSurface, HasItsPointsAndIsATensorProduct) {
  std::mt19937 random(2);
  const std::vector<double> in_u{0, 0.2, 1, 3}, in_v{-1, 0, 2};
  const LagrangeSurface surface((LagrangeBasis(in_u)), (LagrangeBasis(in_v)));
  const Points points = random_points(random, 12, 3);
  for (size_t j = 0; j < 3; ++j)
    for (size_t i = 0; i < 4; ++i)
      expect_near(own_values(surface, points, Coordinates::plain, in_u[i], in_v[j]).x.row(0),
                  points.row(Index(i + 4 * j)), 0);
  const OwnValues at = own_values(surface, points, Coordinates::plain, 0.7, 0.9);
  constexpr int orders[6][2] = {{0, 0}, {1, 0}, {0, 1}, {2, 0}, {1, 1}, {0, 2}};
  for (int r = 0; r < 6; ++r) {
    Eigen::RowVector3d sum(0, 0, 0);
    for (size_t j = 0; j < 3; ++j)
      for (size_t i = 0; i < 4; ++i)
        sum += double(lagrange(in_u, i, 0.7, orders[r][0]) * lagrange(in_v, j, 0.9, orders[r][1])) *
               points.row(Index(i + 4 * j));
    expect_near(at.x.row(r), sum, derivative_sums);
  }
  const std::optional<SplineNet> net = lagrange_net(LagrangeBasis(in_u), LagrangeBasis(in_v), points);
  ASSERT_TRUE(net);
  expect_near(own_values(*net, 0.7, 0.9).x, at.x, derivative_sums);
}

TEST(LagrangeCurve, IsABezierCurveUpToSomeDegree) {
  std::mt19937 random(3);
  for (int n = 1; n <= 30; ++n) {
    std::vector<double> nodes;
    for (int i = 0; i <= n; ++i) nodes.push_back(i);
    const LagrangeBasis basis(nodes);
    const Points points = random_points(random, n + 1, 3);
    const std::optional<CurveNet> net = lagrange_net(basis, points);
    EXPECT_TRUE(net || n > 7) << n;
    EXPECT_TRUE(!net || n <= 25);
    if (!net) continue;
    const LagrangeCurve curve(basis);
    for (const double u : {0.0, 0.013, 0.4, 0.99, 1.0}) {
      const CurvePlace place{0, u};
      expect_near(curve.evaluate(points, std::span(&place, 1)).position, truth(*net, u * n),
                  10 * lagrange_net_accuracy);
    }
  }
}

TEST(LagrangeCurve, HasAParameterOfItsOwn) {
  const LagrangeCurve curve(LagrangeBasis({0.1, 0.4, 0.7}));
  EXPECT_EQ(curve.place(0.1).t, 0);
  EXPECT_EQ(curve.place(0.7).t, 1);
  EXPECT_EQ(curve.place(0.7, KnotSide::left).segment, 0);
  EXPECT_EQ(curve.length(0), curve.basis().length());
  expect_error<InvalidParameter>([&] { curve.place(0.75); }, {"0.75", "0.1 to"});
}

}  // namespace
}  // namespace sublimit::testing
