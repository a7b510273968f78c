// SPDX-License-Identifier: Apache-2.0
// Triangular Bezier patches against Bernstein's polynomials, and their quarters.
#include "sublimit/patches/constructions/triangle_patch.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "meshes/construction_data.h"
#include "support/expect_error.h"

namespace sublimit::testing {
namespace {

double factorial(int n) { return n < 2 ? 1 : n * factorial(n - 1); }
double power(double x, int n) { return n < 0 ? 0 : n == 0 ? 1 : x * power(x, n - 1); }

/// n! / (i! j! k!) a^i b^j c^k and derivatives by u and v, a = 1 - u - v.
double bernstein(int i, int j, int k, double u, double v, int du, int dv) {
  if (i < 0 || j < 0 || k < 0) return 0;
  if (du > 0)
    return (i + j + k) * (bernstein(i, j - 1, k, u, v, du - 1, dv) - bernstein(i - 1, j, k, u, v, du - 1, dv));
  if (dv > 0)
    return (i + j + k) * (bernstein(i, j, k - 1, u, v, du, dv - 1) - bernstein(i - 1, j, k, u, v, du, dv - 1));
  return factorial(i + j + k) / (factorial(i) * factorial(j) * factorial(k)) * power(1 - u - v, i) * power(u, j) *
         power(v, k);
}

TEST(TrianglePatch, RowsAreBernsteins) {
  constexpr int orders[6][2] = {{0, 0}, {1, 0}, {0, 1}, {2, 0}, {1, 1}, {0, 2}};
  for (int n = 1; n <= 9; ++n) {
    const TrianglePatch patch(n);
    for (const auto& [u, v] :
         std::initializer_list<std::pair<double, double>>{{0.2, 0.3}, {0, 0}, {1, 0}, {0, 1}, {0.5, 0.5}, {0.7, 0.0}}) {
      WeightRows rows;
      EXPECT_EQ(patch.rows({0, u, v}, 2, rows), LimitStatus::regular);
      ASSERT_EQ(rows.rows(), 6);
      Index at = 0;
      for (int k = 0; k <= n; ++k)
        for (int j = 0; j + k <= n; ++j, ++at)
          for (int r = 0; r < 6; ++r)
            EXPECT_NEAR(rows(r, at), bernstein(n - j - k, j, k, u, v, orders[r][0], orders[r][1]), 100 * sums);
      ASSERT_EQ(at, patch.num_points());
    }
  }
}

TEST(TrianglePatch, QuartersAreTheSamePatch) {
  std::mt19937 random(1);
  for (const int n : {1, 2, 4, 9}) {
    const auto coarse = std::make_shared<const TrianglePatch>(n);
    const Points control = random_points(random, coarse->num_points(), 3);
    std::shared_ptr<const Patch> patch = coarse;
    Points columns = control;
    for (int level = 1; level <= 3; ++level) {
      const Patch::Refined fine = patch->refined();
      EXPECT_EQ(fine.patch->faces().size, patch->faces().size * 4);
      EXPECT_TRUE(fine.patch->faces().triangles);
      EXPECT_GE(fine.S.coeffs().minCoeff(), 0);
      expect_near(fine.S * Eigen::VectorXd::Ones(fine.S.cols()), Eigen::VectorXd::Ones(fine.S.rows()), sums);
      columns = fine.S * columns;
      patch = fine.patch;
      for (int repeat = 0; repeat < 20; ++repeat) {
        double u = double(random() % 65) / 64, v = double(random() % 65) / 64;
        if (u + v > 1) u = 1 - u, v = 1 - v;
        expect_near(own_values(*patch, columns, Coordinates::plain, u, v).x,
                    own_values(*coarse, control, Coordinates::plain, u, v).x, 1000 * derivative_sums);
        const Place place = patch->place({u, v});
        const Patch::Parameters back = patch->parameters(place);
        EXPECT_NEAR(back.u, u, sums);
        EXPECT_NEAR(back.v, v, sums);
      }
    }
  }
}

TEST(TrianglePatch, QuartersAreNumberedAsDocumented) {
  const TrianglePatch quarters(1, 1);
  // The lattice: 0 1 2 along u, 3 4, 5.
  EXPECT_EQ(quarters.slots(0), (std::vector<Index>{0, 1, 3}));
  EXPECT_EQ(quarters.slots(1), (std::vector<Index>{1, 2, 4}));
  EXPECT_EQ(quarters.slots(2), (std::vector<Index>{3, 4, 5}));
  EXPECT_EQ(quarters.slots(3), (std::vector<Index>{4, 3, 1}));
}

TEST(TrianglePatch, BoundaryIsABezierCurve) {
  std::mt19937 random(2);
  const TrianglePatch patch(5);
  const Points control = random_points(random, patch.num_points(), 3);
  const CurveNet edge{bezier_knots<double>(5), control.topRows(6)};
  for (const double t : {0.0, 0.3, 1.0})
    expect_near(own_values(patch, control, Coordinates::plain, t, 0).x.row(0), truth(edge, t), sums);
}

TEST(TrianglePatch, RefusesDegreesAndPlacesOutside) {
  expect_error<InvalidParameter>([] { TrianglePatch(0); }, {"degree 0", "1 to 25"});
  expect_error<InvalidParameter>([] { TrianglePatch(26); }, {"degree 26"});
  expect_error<ResourceError>([] { TrianglePatch(3, 11); }, {"11 times"});
  const TrianglePatch patch(2);
  expect_error<InvalidParameter>([&] { patch.place({0.6, 0.6}); }, {"outside the triangle"});
  expect_error<InvalidParameter>([&] { patch.stencil({0, 0.6, 0.6}); }, {"outside the triangle"});
}

}  // namespace
}  // namespace sublimit::testing
