// SPDX-License-Identifier: Apache-2.0
// Surfaces of revolution: exact circles, curvatures of cylinder, cone, sphere and torus, other axes.
#include "sublimit/patches/constructions/revolution.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "meshes/construction_data.h"
#include "support/expect_error.h"

namespace sublimit::testing {
namespace {

CurveNet line(double x0, double z0, double x1, double z1) {
  Points points(2, 2);
  points << x0, z0, x1, z1;
  return {bezier_knots<double>(1), points};
}

TEST(Degrees, AreExactWhereTheyCanBe) {
  for (int k = -8; k <= 8; ++k) {
    const double quarter[] = {1, 0, -1, 0};
    EXPECT_EQ(cos_degrees(90 * k), quarter[(k % 4 + 4) % 4]);
    EXPECT_EQ(sin_degrees(90 * k), quarter[((k - 1) % 4 + 4) % 4]);
  }
  EXPECT_EQ(cos_degrees(60), 0.5);
  EXPECT_EQ(sin_degrees(-30), -0.5);
  for (double a = -400; a < 400; a += 7.3) {
    constexpr double in_radians = 1e-14;  // the argument is rounded when it is turned into radians
    EXPECT_NEAR(cos_degrees(a), std::cos(a * std::numbers::pi / 180), in_radians);
    EXPECT_NEAR(sin_degrees(a), std::sin(a * std::numbers::pi / 180), in_radians);
  }
}

TEST(Revolution, KeepsRadiusAndHeight) {
  for (const auto& [sweep, count] : std::initializer_list<std::pair<double, int>>{
           {360, 0}, {360, 3}, {-360, 4}, {90, 0}, {170, 1}, {1, 0}, {-200, 0}, {360, 7}}) {
    const SplineNet net = revolution(line(1, -1, 3, 2), {.start_degrees = 20, .sweep_degrees = sweep, .arcs = count});
    const double end = net.surface->u().end();
    if (count == 0) {
      EXPECT_EQ(end, std::ceil(std::abs(sweep) / 90));
    }
    for (double u = 0; u <= end; u += end / 16)
      for (const double v : {0.0, 0.3, 1.0}) {
        const OwnValues at = own_values(net, u, v);
        constexpr double quotient = 1e-14;  // of sums of three products
        EXPECT_NEAR(std::hypot(at.x(0, 0), at.x(0, 1)), 1 + 2 * v, quotient);
        EXPECT_NEAR(at.x(0, 2), -1 + 3 * v, quotient);
        EXPECT_NEAR(curvatures(at).first, 0, derivative_sums);  // a cone
      }
    // u = m / 2 are equal angles.
    for (int m = 0; m <= 2 * int(end); ++m) {
      const double angle = 20 + sweep * m / (2 * end);
      expect_near(own_values(net, m / 2.0, 0).x.row(0), Eigen::RowVector3d(cos_degrees(angle), sin_degrees(angle), -1),
                  sums);
    }
  }
}

TEST(Revolution, CirclesAreOnceDifferentiableAtJoints) {
  const SplineNet net = revolution(line(1, 0, 1, 1));
  const auto at = [&](KnotSide side) {
    const Place place = net.surface->place({1, 0.5, side, KnotSide::right});
    return net.surface->evaluate(net.columns, std::span(&place, 1), 2, net.coordinates);
  };
  const LimitSamples before = at(KnotSide::left), after = at(KnotSide::right);
  expect_near(before.du, after.du, sums);
  // Columns are continuous there and no more, the circle has a derivative: 4 - 2 sqrt(2) - 2 = -0.828 one way along it.
  const double jump = 2 * std::numbers::sqrt2 - 2;
  EXPECT_NEAR(std::abs(before.duu(0, 0)), jump, derivative_sums);
  EXPECT_NEAR(before.duu(0, 0), -after.duu(0, 0), derivative_sums);
  EXPECT_NEAR(before.duu(0, 1), after.duu(0, 1), derivative_sums);
  EXPECT_EQ(before.status[0], LimitStatus::crease);
}

TEST(Revolution, ComesBackToTheSameColumns) {
  const SplineNet net =
      revolution(line(1, 0, 2, 1), {.start_degrees = 33, .axis = {.point = {1, 2, 3}, .direction = {1, 1, 0}}});
  for (Index j = 0; j < 2; ++j) EXPECT_EQ(net.columns.row(9 * j), net.columns.row(9 * j + 8));
}

TEST(Revolution, OfALineIsACylinderOfMeanCurvatureMinusOneHalf) {
  const auto [gauss, mean] = curvatures(own_values(revolution(line(2, 0, 2, 1)), 0.7, 0.5));
  EXPECT_NEAR(gauss, 0, derivative_sums);
  EXPECT_NEAR(mean, -0.25, derivative_sums);  // radius 2, normals outwards
}

TEST(Revolution, OfCirclesAreSphereAndTorus) {
  const double r = 2;
  const SplineNet sphere = revolution(circle_arcs(0, r, 2));
  EXPECT_EQ(sphere.columns.rows(), 9 * 5);
  const SplineNet torus = revolution(circle_arcs(3, 1, 4));
  for (double u = 0.05; u < 4; u += 0.37)
    for (double v = 0.05; v < 2; v += 0.31) {
      const OwnValues at = own_values(sphere, u, v);
      constexpr double quotient = 1e-14;    // of sums of nine products
      constexpr double of_quartic = 1e-12;  // terms of size 256
      EXPECT_NEAR(at.x.row(0).norm(), r, quotient);
      const auto [gauss, mean] = curvatures(at);
      EXPECT_NEAR(gauss, 1 / (r * r), derivative_sums);
      EXPECT_NEAR(mean, -1 / r, derivative_sums);
      const OwnValues on_torus = own_values(torus, u, 2 * v);
      const Eigen::RowVector3d x = on_torus.x.row(0);
      const double quartic = std::pow(x.squaredNorm() + 9 - 1, 2) - 36 * (x[0] * x[0] + x[1] * x[1]);
      EXPECT_NEAR(quartic, 0, of_quartic);
      const double across = std::hypot(x[0], x[1]) - 3;
      EXPECT_NEAR(curvatures(on_torus).first, across / (3 + across), derivative_sums);  // cos / (R + cos)
    }
}

TEST(Revolution, AboutOtherAxesIsTheRigidImage) {
  const CurveNet profile = line(1, -1, 3, 2);
  const SplineNet about_z = revolution(profile);
  for (const Axis& axis : {Axis{{1, 2, 3}, {1, -2, 0.5}}, Axis{{0, 0, 0}, {0, 0, -4}}, Axis{{0, 1, 0}, {1, 0, 0}}}) {
    const Eigen::Matrix3d turn = axis.turn();
    expect_near(turn * turn.transpose(), Eigen::Matrix3d::Identity(), sums);
    EXPECT_NEAR(turn.determinant(), 1, sums);
    expect_near(turn.col(2).transpose(), axis.direction.normalized(), sums);
    const SplineNet net = revolution(profile, {.axis = axis});
    for (const double u : {0.0, 0.7, 3.2}) {
      const Eigen::RowVector3d x = own_values(about_z, u, 0.4).x.row(0);
      expect_near(own_values(net, u, 0.4).x.row(0), axis.point + x * turn.transpose(), sums);
    }
  }
}

TEST(Revolution, NegativeSweepsTurnTheNormal) {
  const OwnValues one = own_values(revolution(line(1, 0, 1, 1), {.sweep_degrees = 90}), 0, 0.5),
                  other = own_values(revolution(line(1, 0, 1, 1), {.sweep_degrees = -90}), 0, 0.5);
  expect_near(one.normal, -other.normal, sums);
}

TEST(Revolution, RefusesWhatIsNone) {
  const CurveNet profile = line(1, 0, 1, 1);
  for (const auto& [options, part] : std::initializer_list<std::pair<RevolutionOptions, const char*>>{
           {{.sweep_degrees = 0}, "a sweep of 0 degrees"},
           {{.sweep_degrees = 361}, "a sweep of 361 degrees: it must be more than 0 and 360 at most"},
           {{.sweep_degrees = std::nan("")}, "a sweep of nan"},
           {{.start_degrees = INFINITY}, "a start of inf"},
           {{.sweep_degrees = 360, .arcs = 2},
            "2 arcs of 360 degrees: each must be less than 180 degrees, so there must be 3"},
           {{.sweep_degrees = 180, .arcs = 1}, "2 or more"},
           {{.axis = {.direction = {0, 0, 0}}}, "axis"}})
    expect_error<InvalidParameter>([&, &options = options] { revolution(profile, options); }, {part});
  expect_error<InvalidParameter>(
      [&] {
        revolution({bezier_knots<double>(1), Points::Zero(2, 3)});
      },
      {"profile", "(x, z)"});
}

}  // namespace
}  // namespace sublimit::testing
