// SPDX-License-Identifier: Apache-2.0
// Curves in other bases, and graphs of functions, against their formulas.
#include "sublimit/patches/constructions/polynomial_curves.h"

#include <gtest/gtest.h>

#include <cmath>

#include "meshes/construction_data.h"
#include "sublimit/patches/constructions/graph.h"
#include "sublimit/patches/constructions/power_coefficients.h"
#include "support/expect_error.h"

namespace sublimit::testing {
namespace {

TEST(PowersAsSplines, AreThePowers) {
  std::mt19937 random(1);
  for (int degree = 1; degree <= 7; ++degree) {
    const Knots<double> knots = unit_knots(random, degree);
    const CurveNet powers{knots, polynomial_points(knots, Eigen::MatrixXd::Identity(degree + 1, degree + 1))};
    for (const double t : {0.0, 0.3, 0.875, 1.0})
      for (int k = 0; k <= degree; ++k) EXPECT_NEAR(truth(powers, t)[k], std::pow(t, k), sums);
    const std::vector<double> greville = knots.greville();
    for (Index i = 0; i < knots.num_points(); ++i) EXPECT_NEAR(powers.columns(i, 1), greville[size_t(i)], sums);
  }
}

TEST(TaylorCurve, IsThePolynomial) {
  std::mt19937 random(2);
  const Points a = random_points(random, 6, 2);
  const CurveNet curve = taylor_curve(a, -1, 2);
  for (const double t : {-1.0, 0.0, 0.7, 2.0}) {
    Eigen::RowVectorXd sum = Eigen::RowVectorXd::Zero(2);
    for (Index k = 5; k >= 0; --k) sum = sum * t + a.row(k);  // Horner
    expect_near(truth(curve, t), sum, 100 * sums);
  }
}

TEST(HermiteCurve, IsTheDocumentedBezierCurve) {
  std::mt19937 random(3);
  const Points P = random_points(random, 2, 3), T = random_points(random, 2, 3);
  Points bezier(4, 3);
  bezier << P.row(0), P.row(0) + T.row(0) / 3, P.row(1) - T.row(1) / 3, P.row(1);
  expect_near(hermite_curve(P, T).columns, bezier, sums);
}

TEST(MatrixCurve, OfCoonsIsTheUniformCubicBSpline) {
  std::mt19937 random(4);
  Eigen::MatrixXd M(4, 4);
  M << 1, -3, 3, -1, 4, 0, -6, 3, 1, 3, 3, -3, 0, 0, 0, 1;
  const Points points = random_points(random, 7, 3);
  const CurveNet curve = matrix_curve({.matrix = M / 6, .step = 1, .points = points, .ends = {}});
  EXPECT_EQ(curve.knots.num_faces(), 4);
  EXPECT_EQ(curve.knots.num_points(), 13);  // neighbours share their ends
  const CurveNet spline{Knots<double>::open(3, 7, {-3, -2, -1, 0, 1, 2, 3, 4, 5, 6, 7}), points};
  for (const double t : {0.0, 0.4, 1.0, 2.5, 4.0}) expect_near(truth(curve, t), truth(spline, t), sums);
}

TEST(MatrixCurve, OfCatmullRomHasItsPoints) {
  std::mt19937 random(5);
  Eigen::MatrixXd M(4, 4);
  M << 0, -0.5, 1, -0.5, 1, 0, -2.5, 1.5, 0, 0.5, 2, -1.5, 0, 0, -0.5, 0.5;
  const Points points = random_points(random, 6, 2);
  const CurveNet curve = matrix_curve({.matrix = M, .step = 1, .points = points, .ends = {0, 2, 3, 7}});
  expect_near(truth(curve, 0), points.row(1), sums);
  expect_near(truth(curve, 2), points.row(2), sums);
  expect_near(truth(curve, 7), points.row(4), sums);
}

TEST(MatrixCurve, OfHermiteTakesPointsAndTangentsInSteps) {
  std::mt19937 random(6);
  Eigen::MatrixXd M(4, 4);  // P0 T0 P1 T1
  M << 1, 0, -3, 2, 0, 1, -2, 1, 0, 0, 3, -2, 0, 0, -1, 1;
  const Points data = random_points(random, 6, 2);
  const CurveNet curve = matrix_curve({.matrix = M, .step = 2, .points = data, .ends = {}});
  expect_near(truth(curve, 1), data.row(2), sums);
  expect_near(truth(curve, 1, 1), data.row(3), 10 * sums);
}

TEST(MatrixCurve, JumpsWhereSegmentsDo) {
  const Points points = (Points(4, 1) << 0, 1, 5, 7).finished();
  Eigen::MatrixXd M(2, 2);
  M << 1, -1, 0, 1;
  const CurveNet curve = matrix_curve({.matrix = M, .step = 2, .points = points, .ends = {}});
  EXPECT_EQ(curve.knots.num_points(), 4);
  EXPECT_EQ(truth(curve, 0.5)[0], 0.5);
  EXPECT_EQ(truth(curve, 1)[0], 5);
}

TEST(PolynomialCurves, RefuseCounts) {
  Eigen::MatrixXd M = Eigen::MatrixXd::Identity(3, 3);
  const Points points = Points::Zero(6, 2);
  expect_error<InvalidParameter>(
      [&] {
        matrix_curve({M, 2, points, {}});
      },
      {"6 points in steps of 2 for degree 2: 5 or 7"});
  expect_error<InvalidParameter>([&] { matrix_curve({M, 1, points.topRows(2), {}}); }, {"3 at least"});
  expect_error<InvalidParameter>([&] { matrix_curve({M, 1, points, {0, 1}}); }, {"2 ends of 4 segments: 5"});
  expect_error<InvalidParameter>([&] { matrix_curve({M, 3, points, {0, 1, 1}}); }, {"end 2 of segments is 1"});
  expect_error<InvalidParameter>([&] { matrix_curve({M, 0, points, {}}); }, {"step 0"});
  expect_error<InvalidParameter>([&] { bezier_curve(Points::Zero(30, 2)); }, {"degree 26"});
  expect_error<InvalidParameter>([&] { bezier_curve(points, 1, 0); }, {"knots must not fall"});
  expect_error<InvalidParameter>([&] { hermite_curve(points, points); }, {"2 points and 2 tangents"});
}

TEST(FunctionalSurface, IsTheGraph) {
  std::mt19937 random(7);
  const Knots<double> u = unit_knots(random, 3), v = unit_knots(random, 2);
  const Eigen::VectorXd values = random_points(random, u.num_points() * v.num_points(), 1);
  const SplineNet net = functional_surface(u, v, values);
  for (const double x : {0.0, 0.3, 1.0})
    for (const double y : {0.1, 0.9}) {
      const OwnValues at = own_values(net, x, y);
      EXPECT_NEAR(at.x(0, 0), x, sums);
      EXPECT_NEAR(at.x(0, 1), y, sums);
    }
  expect_error<InvalidParameter>([&] { functional_surface(u, v, values.head(3)); }, {"3 values", "are needed"});
}

}  // namespace
}  // namespace sublimit::testing
