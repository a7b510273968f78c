// SPDX-License-Identifier: Apache-2.0
// Surfaces of straight lines against their formulas, and what their curvature says.
#include "sublimit/patches/constructions/ruled.h"

#include <gtest/gtest.h>

#include "meshes/construction_data.h"
#include "support/expect_error.h"

namespace sublimit::testing {
namespace {

CurveNet rational_curve(std::mt19937& random, int degree) {
  CurveNet curve = homogeneous(unit_curve(random, degree));
  for (Eigen::Index i = 0; i < curve.columns.rows(); ++i) curve.columns.row(i) *= 0.5 + double(random() % 8) / 4;
  return curve;
}

Eigen::RowVector3d projected(const Eigen::RowVectorXd& column) { return column.head(3) / column[3]; }

TEST(Ruled, BlendsTwoCurves) {
  std::mt19937 random(1);
  for (int repeat = 0; repeat < 20; ++repeat) {
    const CurveNet c0 = unit_curve(random, 1 + int(random() % 4)), c1 = unit_curve(random, 1 + int(random() % 4));
    const SplineNet net = ruled(c0, c1);
    for (const double u : {0.0, 0.3, 0.75, 1.0})
      for (const double v : {0.0, 0.4, 1.0}) {
        const OwnValues at = own_values(net, u, v);
        expect_near(at.x.row(0), (1 - v) * truth(c0, u) + v * truth(c1, u), sums);
        expect_near(at.x.row(2), truth(c1, u) - truth(c0, u), sums);
      }
    EXPECT_LE(curvatures(own_values(net, 0.3, 0.6)).first, sums);  // K <= 0
  }
}

TEST(Ruled, BlendsColumnsOfRationalCurves) {
  std::mt19937 random(2);
  const CurveNet c0 = rational_curve(random, 2), c1 = unit_curve(random, 3);
  const SplineNet net = ruled(c0, c1);
  EXPECT_EQ(net.coordinates, Coordinates::homogeneous);
  const Eigen::RowVectorXd column = 0.75 * truth(c0, 0.4) + 0.25 * truth(homogeneous(c1), 0.4);
  expect_near(own_values(net, 0.4, 0.25).x.row(0), projected(column), sums);
  // The same lines: all points of one are on the line through its ends.
  const Eigen::RowVector3d a = own_values(net, 0.4, 0).x.row(0), b = own_values(net, 0.4, 1).x.row(0),
                           x = own_values(net, 0.4, 0.25).x.row(0);
  EXPECT_NEAR((x - a).cross(b - a).norm(), 0, sums);
}

TEST(Ruled, BilinearPatchOfFourPoints) {
  Points corners(4, 3);
  corners << 0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 1;
  const OwnValues at = own_values(bilinear_patch(corners), 0.25, 0.5);
  expect_near(at.x.row(0), Eigen::RowVector3d(0.25, 0.5, 0.125), sums);  // z = x y
  EXPECT_LT(curvatures(at).first, 0);
}

TEST(Extrusion, MovesACurveAndHasNoGaussCurvature) {
  std::mt19937 random(3);
  const Eigen::RowVector3d direction(0.5, -1, 2);
  for (const CurveNet& curve : {unit_curve(random, 3), rational_curve(random, 2)}) {
    const SplineNet net = extrusion(curve, direction);
    for (const double u : {0.1, 0.6}) {
      const OwnValues at = own_values(net, u, 0.3);
      const Eigen::RowVector3d point =
          curve.coordinates == Coordinates::plain ? Eigen::RowVector3d(truth(curve, u)) : projected(truth(curve, u));
      expect_near(at.x.row(0), point + 0.3 * direction, sums);
      EXPECT_NEAR(curvatures(at).first, 0, derivative_sums);
    }
  }
}

TEST(Cone, HasAnApexAndNoGaussCurvature) {
  std::mt19937 random(4);
  const Eigen::RowVector3d apex(1, 2, 3);
  for (const CurveNet& curve : {unit_curve(random, 3), rational_curve(random, 2)}) {
    const SplineNet net = cone(curve, apex);
    const OwnValues at = own_values(net, 0.4, 0.25);
    const Eigen::RowVector3d point =
        curve.coordinates == Coordinates::plain ? Eigen::RowVector3d(truth(curve, 0.4)) : projected(truth(curve, 0.4));
    expect_near(at.x.row(0), 0.75 * point + 0.25 * apex, sums);
    EXPECT_NEAR(curvatures(at).first, 0, derivative_sums);
    const OwnValues tip = own_values(net, 0.4, 1);
    expect_near(tip.x.row(0), apex, sums);
    EXPECT_EQ(tip.status, LimitStatus::undefined_normal);
  }
}

TEST(Ruled, RefusesOtherDomainsAndShapes) {
  std::mt19937 random(5);
  const CurveNet long_one{Knots<double>::open(1, 2, {0, 0, 2, 2}), random_points(random, 2, 3)};
  expect_error<InvalidParameter>([&] { ruled(unit_curve(random, 1), long_one); }, {"domain", "0 to 2"});
  const CurveNet flat{bezier_knots<double>(1), random_points(random, 2, 2)};
  expect_error<InvalidParameter>([&] { ruled(flat, flat); }, {"c0: columns are 2 x 2, not 2 x 3"});
}

}  // namespace
}  // namespace sublimit::testing
