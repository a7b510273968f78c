// SPDX-License-Identifier: Apache-2.0
// Splines through points, against the conditions and against the tridiagonal system of cubic splines.
#include "sublimit/patches/constructions/interpolation.h"

#include <gtest/gtest.h>

#include <limits>

#include <Eigen/LU>

#include "meshes/construction_data.h"
#include "support/expect_error.h"

namespace sublimit::testing {
namespace {

std::vector<double> random_parameters(std::mt19937& random, int count) {
  std::vector<double> parameters{0.5};
  while (std::ssize(parameters) < count) parameters.push_back(parameters.back() + 0.25 + double(random() % 8) / 8);
  return parameters;
}

TEST(InterpolatingBSpline, HasItsPoints) {
  std::mt19937 random(1);
  for (int degree = 0; degree <= 5; ++degree)
    for (int count = degree + 1; count < degree + 12; ++count) {
      if (count == 1) continue;
      const std::vector<double> parameters = random_parameters(random, count);
      const Points points = random_points(random, count, 3);
      const Knots<double> knots = averaged_knots(degree, parameters);
      const CurveNet curve{knots, interpolating_points(knots, parameters, points)};
      for (int i = 0; i < count; ++i) expect_near(truth(curve, parameters[size_t(i)]), points.row(i), 100 * sums);
    }
}

TEST(InterpolatingBSpline, ReproducesItself) {
  std::mt19937 random(2);
  const std::vector<double> parameters = random_parameters(random, 9);
  const Knots<double> knots = averaged_knots(3, parameters);
  const CurveNet given{knots, random_points(random, 9, 2)};
  Points values(9, 2);
  for (Index i = 0; i < 9; ++i) values.row(i) = truth(given, parameters[size_t(i)]);
  expect_near(interpolating_points(knots, parameters, values), given.columns, 10 * sums);
}

TEST(AveragedKnots, AreMeans) {
  const Knots<double> knots = averaged_knots(2, std::vector<double>{0, 1, 3, 4, 8});
  EXPECT_EQ(std::vector<double>(knots.all().begin(), knots.all().end()),
            (std::vector<double>{0, 0, 0, 2, 3.5, 8, 8, 8}));
}

TEST(InterpolatingBSpline, NamesParametersAndKnots) {
  const Knots<double> knots = Knots<double>::open(1, 4, {0, 0, 1, 2, 3, 3});
  const Points points = Points::Zero(4, 2);
  expect_error<InvalidParameter>(
      [&] {
        interpolating_points(knots, std::vector<double>{0, 0.2, 0.4, 3}, points);
      },
      {"parameter 2 is 0.4", "between knots 2 and 4, which are 1 and 3"});
  expect_error<InvalidParameter>(
      [&] {
        interpolating_points(knots, std::vector<double>{0, 1, 1, 3}, points);
      },
      {"parameters 1 and 2 are both 1"});
  expect_error<InvalidParameter>(
      [&] {
        interpolating_points(knots, std::vector<double>{0, 2, 1, 3}, points);
      },
      {"parameter 2 is 1, less than the one before, 2"});
  expect_error<InvalidParameter>(
      [&] {
        interpolating_points(knots, std::vector<double>{0, 1, 3}, points);
      },
      {"4 points at 3 parameters for 4 control points"});
  expect_error<InvalidParameter>(
      [] {
        averaged_knots(3, std::vector<double>{0, 1});
      },
      {"2 parameters for degree 3", "4 at least"});
  expect_error<InvalidParameter>(
      [] {
        averaged_knots(1, std::vector<double>{0, std::nan("")});
      },
      {"parameter 1 is nan"});
}

/// Derivatives of the cubic spline by the textbook's system: h_i d_{i-1} + 2 (h_{i-1} + h_i) d_i + h_{i-1} d_{i+1} =
/// 3 (h_i s_{i-1} + h_{i-1} s_i).
Points textbook_derivatives(CubicEnds ends, const std::vector<double>& tau, const Points& Q, const Points& given) {
  const Index n = static_cast<Index>(tau.size());
  const bool periodic = ends == CubicEnds::periodic;
  const Index unknowns = periodic ? n - 1 : n;
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(unknowns, unknowns), b = Eigen::MatrixXd::Zero(unknowns, Q.cols());
  const auto h = [&](Index i) { return tau[size_t(i) + 1] - tau[size_t(i)]; };
  const auto s = [&](Index i) { return Eigen::RowVectorXd((Q.row(i + 1) - Q.row(i)) / h(i)); };
  for (Index i = periodic ? 0 : 1; i < n - 1; ++i) {
    const Index before = i > 0 ? i - 1 : n - 2;
    const Index left = i > 0 ? i - 1 : n - 2, right = periodic ? (i + 1) % (n - 1) : i + 1;
    A(i, left) += h(i), A(i, i) += 2 * (h(before) + h(i)), A(i, right) += h(before);
    b.row(i) = 3 * (h(i) * s(before) + h(before) * s(i));
  }
  if (ends == CubicEnds::natural) {
    A(0, 0) = 2, A(0, 1) = 1, b.row(0) = 3 * s(0);
    A(n - 1, n - 1) = 2, A(n - 1, n - 2) = 1, b.row(n - 1) = 3 * s(n - 2);
  }
  if (ends == CubicEnds::clamped) {
    A(0, 0) = A(n - 1, n - 1) = 1;
    b.row(0) = given.row(0), b.row(n - 1) = given.row(1);
  }
  return A.fullPivLu().solve(b);
}

TEST(InterpolatingCubic, IsTheTextbooks) {
  std::mt19937 random(3);
  for (const CubicEnds ends : {CubicEnds::natural, CubicEnds::clamped, CubicEnds::periodic})
    for (int count = 3; count < 12; ++count) {
      const std::vector<double> tau = random_parameters(random, count);
      Points Q = random_points(random, count, 2);
      if (ends == CubicEnds::periodic) Q.row(count - 1) = Q.row(0);
      const Points given = ends == CubicEnds::clamped ? random_points(random, 2, 2) : Points();
      const CurveNet curve = interpolating_cubic(ends, tau, Q, given);
      const Points d = textbook_derivatives(ends, tau, Q, given);
      for (Index i = 0; i < d.rows(); ++i) {
        expect_near(column_at(curve, tau[size_t(i)]), Q.row(i), 100 * sums);
        expect_near(column_at(curve, tau[size_t(i)], 1), d.row(i), 1000 * sums);
      }
      if (ends == CubicEnds::periodic) {
        const CurveNet short_one = interpolating_cubic(ends, tau, Q.topRows(count - 1));
        expect_near(short_one.columns, curve.columns, 0);
      }
    }
}

TEST(InterpolatingCubic, OfTwoPointsIsALine) {
  Points Q(2, 2);
  Q << 0, 0, 2, 4;
  const CurveNet curve = interpolating_cubic(CubicEnds::natural, std::vector<double>{0, 1}, Q);
  expect_near(column_at(curve, 0.25), Eigen::RowVector2d(0.5, 1), sums);
}

TEST(InterpolatingCubic, RefusesWithCounts) {
  const std::vector<double> tau{0, 1, 2};
  Points Q(3, 2);
  Q << 0, 0, 1, 0, 0.5, 0;
  expect_error<InvalidMesh>([&] { interpolating_cubic(CubicEnds::periodic, tau, Q); }, {"0.5 from its first"});
  expect_error<InvalidParameter>([&] { interpolating_cubic(CubicEnds::clamped, tau, Q); },
                                 {"0 end derivatives", "clamped need 2"});
  expect_error<InvalidParameter>([&] { interpolating_cubic(CubicEnds::natural, tau, Q, Q.topRows(2)); },
                                 {"natural need 0"});
  expect_error<InvalidParameter>([&] { interpolating_cubic(CubicEnds::natural, tau, Q.topRows(2)); },
                                 {"2 points at 3 parameters"});
}

}  // namespace
}  // namespace sublimit::testing
