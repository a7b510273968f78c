// SPDX-License-Identifier: Apache-2.0
#include "sublimit/patches/constructions/screw_surface.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "meshes/construction_data.h"
#include "support/expect_error.h"

namespace sublimit::testing {
namespace {

constexpr double pi = std::numbers::pi;

TEST(ScrewSurface, TurnsAndRises) {
  std::mt19937 random(1);
  for (const bool rational : {false, true}) {
    CurveNet curve = unit_curve(random, 3);
    if (rational) curve = homogeneous(curve), curve.columns.row(1) *= 2;
    const double pitch = 1.5;
    const ScrewSurface surface(curve.knots, -1, 7);
    const Points columns = surface.columns(curve, pitch);
    EXPECT_EQ(surface.faces().size, 6 * curve.knots.num_faces());
    for (const double u : {-1.0, 0.0, 0.3, 4.0, 7.0})
      for (const double v : {0.0, 0.4, 1.0}) {
        const OwnValues at = own_values(surface, columns, curve.coordinates, u, v);
        Eigen::RowVectorXd c = truth(curve, v);
        if (rational) c = Eigen::RowVectorXd(c.head(3) / c[3]);
        const double x = std::cos(u) * c[0] - std::sin(u) * c[1], y = std::sin(u) * c[0] + std::cos(u) * c[1];
        expect_near(at.x.row(0), Eigen::RowVector3d(x, y, c[2] + u * pitch / (2 * pi)), 10 * sums);
        expect_near(at.x.row(1), Eigen::RowVector3d(-y, x, pitch / (2 * pi)), 100 * sums);
        expect_near(at.x.row(3), Eigen::RowVector3d(-x, -y, 0), 1000 * sums);
      }
    for (const LimitStencil& stencil : {surface.stencil({2, 0.3, 0.6}, 2)}) {
      EXPECT_NEAR(stencil.weights.row(0).sum(), 1, sums);
      for (int r = 1; r < 6; ++r) EXPECT_NEAR(stencil.weights.row(r).sum(), 0, 100 * sums);
    }
  }
}

TEST(ScrewSurface, OfALineIsTheHelicoidWhichIsMinimal) {
  Points ends(2, 3);
  ends << -1, 0, 0, 3, 0, 0;
  const CurveNet line{bezier_knots<double>(1), ends};
  const double pitch = 2, c = pitch / (2 * pi);
  const ScrewSurface surface(line.knots, 0, 2 * pi);
  EXPECT_EQ(surface.faces().size, 4);
  const Points columns = surface.columns(line, pitch);
  for (const double u : {0.1, 2.0, 6.0})
    for (const double v : {0.0, 0.3, 0.8}) {
      const double r = -1 + 4 * v;
      const auto [gauss, mean] = curvatures(own_values(surface, columns, Coordinates::plain, u, v));
      EXPECT_NEAR(mean, 0, derivative_sums);
      EXPECT_NEAR(gauss, -c * c / std::pow(r * r + c * c, 2), derivative_sums);
    }
}

TEST(ScrewSurface, PlacesGoBackAndForth) {
  const ScrewSurface surface(bezier_knots<double>(2), 0, 3);
  for (const double u : {0.0, 0.7, 1.5, 2.9, 3.0}) {
    const Patch::Parameters back = surface.parameters(surface.place({u, 0.25}));
    EXPECT_NEAR(back.u, u, sums);
    EXPECT_EQ(back.v, 0.25);
  }
  EXPECT_EQ(surface.place({1.5, 0}).face, 1);
  EXPECT_EQ(surface.place({1.5, 0, KnotSide::left}).face, 0);
}

TEST(ScrewSurface, RefusesAngles) {
  const Knots<double> knots = bezier_knots<double>(1);
  expect_error<InvalidParameter>([&] { ScrewSurface(knots, 1, 1); }, {"u from 1 to 1"});
  expect_error<InvalidParameter>([&] { ScrewSurface(knots, 0, INFINITY); }, {"finite"});
  expect_error<InvalidParameter>([&] { ScrewSurface(knots, 0, 1e9); }, {"turns"});
  const ScrewSurface surface(knots, 0, 1);
  expect_error<InvalidParameter>([&] { surface.place({2, 0}); }, {"2 is outside the domain, 0 to 1"});
}

}  // namespace
}  // namespace sublimit::testing
