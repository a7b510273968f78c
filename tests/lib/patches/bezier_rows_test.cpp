// SPDX-License-Identifier: Apache-2.0
// Faces as Bezier nets: of every kind of patch that is polynomial, Bernstein polynomials times its rows are the
// patch's.
#include <gtest/gtest.h>

#include <functional>
#include <random>

#include "sublimit/core/detail/binomial.h"
#include "sublimit/patches/detail/basis_surface.h"
#include "sublimit/patches/constructions/lagrange_surface.h"
#include "sublimit/patches/constructions/screw_surface.h"
#include "sublimit/patches/constructions/triangle_patch.h"
#include "sublimit/patches/detail/cut_patch.h"
#include "sublimit/patches/spline_surface.h"
#include "support/tolerance.h"

namespace sublimit::testing {
namespace {

struct Case {
  const char* name;
  std::shared_ptr<const Patch> patch;
};

std::vector<Case> polynomial_patches() {
  const Knots<double> uneven = Knots<double>::open(3, 6, {-1, 0, 0, 0.5, 2, 2, 3, 3, 4, 5}),
                      closed = Knots<double>::closed(2, {0, 1, 1.5, 3, 4});
  const auto spline = std::make_shared<const SplineSurface>(uneven, closed);
  const auto cardinal =
      std::make_shared<const BasisSurface>(SegmentBasis::cardinal({0, 1, 2}), SegmentBasis::taylor(2, {0, 0.5, 2}));
  return {
      {"spline", spline},
      {"steps", std::make_shared<const SplineSurface>(Knots<double>::open(0, 2, {0, 1, 2}), closed)},
      {"segments", cardinal},
      {"triangle", std::make_shared<const TrianglePatch>(4, 1)},
      {"points", std::make_shared<const LagrangeSurface>(LagrangeBasis({0, 1, 2.5, 3}), LagrangeBasis({2, 0, 1}))},
      {"cut spline", std::make_shared<const CutPatch>(spline, Eigen::Array2d(0.75, 0.5), Eigen::Array2d(2.5, 3.5))},
      {"cut segments", std::make_shared<const CutPatch>(cardinal, Eigen::Array2d(0.5, 0.25), Eigen::Array2d(1.75, 1))}};
}

/// Bernstein polynomials at a place, in the order of the rows.
Eigen::RowVectorXd bernstein(const Patch::BezierRows& bezier, bool triangle, double u, double v) {
  const auto power = [](double x, int n) { return n == 0 ? 1 : std::pow(x, n); };
  Eigen::RowVectorXd values(bezier.rows.rows());
  Eigen::Index at = 0;
  const int p = bezier.degree_u, q = bezier.degree_v;
  for (int j = 0; j <= q; ++j)
    for (int i = 0; i <= (triangle ? p - j : p); ++i)
      values[at++] = triangle ? double(binomial(p, i)) * double(binomial(p - i, j)) * power(u, i) * power(v, j) *
                                    power(1 - u - v, p - i - j)
                              : double(binomial(p, i)) * power(u, i) * power(1 - u, p - i) * double(binomial(q, j)) *
                                    power(v, j) * power(1 - v, q - j);
  EXPECT_EQ(at, values.size());
  return values;
}

TEST(BezierRows, AreTheRowsOfThePatch) {
  std::mt19937 random(5);
  std::uniform_real_distribution<> parameter(0, 1);
  for (const auto& [name, patch] : polynomial_patches()) {
    const bool triangle = patch->faces().triangles;
    for (Index face = 0; face < patch->faces().size; ++face) {
      const std::optional<Patch::BezierRows> bezier = patch->bezier(face);
      ASSERT_TRUE(bezier) << name;
      ASSERT_EQ(bezier->rows.cols(), std::ssize(patch->slots(face))) << name;
      const double size = bezier->rows.cwiseAbs().rowwise().sum().maxCoeff();
      for (int trial = 0; trial < 8; ++trial) {
        const double u = trial == 0 ? 0 : trial == 1 ? 1 : parameter(random);
        const double v = trial == 0 ? 1 : trial == 1 ? 0 : parameter(random) * (triangle ? 1 - u : 1);
        WeightRows expected;
        patch->rows({face, u, v}, 0, expected);
        EXPECT_LE((bernstein(*bezier, triangle, u, v) * bezier->rows - expected.row(0)).cwiseAbs().maxCoeff(),
                  rounding(20, size))
            << name << " face " << face << " at " << u << " " << v;
      }
    }
  }
}

TEST(BezierRows, AreNotThereWhereThereIsNoPolynomial) {
  const ScrewSurface screw(bezier_knots<double>(2), 0, 3);
  EXPECT_FALSE(screw.bezier(0));
  std::vector<double> nodes(25);
  for (size_t i = 0; i < nodes.size(); ++i) nodes[i] = double(i);
  const LagrangeSurface wild{LagrangeBasis(nodes), LagrangeBasis({0, 1})};
  EXPECT_FALSE(wild.bezier(0));
}

}  // namespace
}  // namespace sublimit::testing
