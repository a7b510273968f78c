// SPDX-License-Identifier: Apache-2.0
#pragma once
// Random curves, and values of surfaces at their own parameters, for tests of constructions.
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <numeric>
#include <random>
#include <utility>
#include <vector>

#include "sublimit/patches/constructions/revolution.h"
#include "sublimit/patches/constructions/spline_net.h"
#include "truth/classical_splines.h"
#include "truth/precise.h"

namespace sublimit::testing {

/// Returns clamped knots on [0, 1] with some inner ones, simple or multiple.
inline Knots<double> unit_knots(std::mt19937& random, int degree) {
  std::vector<double> inner;
  for (int i = 1; i < 8; ++i)
    if (random() % 4 == 0) inner.insert(inner.end(), 1 + random() % size_t(degree), i / 8.0);
  std::vector<double> knots(size_t(degree) + 1, 0);
  knots.insert(knots.end(), inner.begin(), inner.end());
  knots.insert(knots.end(), size_t(degree) + 1, 1);
  const auto points = static_cast<Index>(knots.size()) - degree - 1;
  return Knots<double>::open(degree, points, std::move(knots));
}

/// Returns open knots 0, 1, 2, ... for so many control points.
inline Knots<double> uniform_knots(int degree, Index points) {
  std::vector<double> knots(size_t(points + degree + 1));
  std::iota(knots.begin(), knots.end(), 0);
  return Knots<double>::open(degree, points, knots);
}

inline CurveNet unit_curve(std::mt19937& random, int degree) {
  Knots<double> knots = unit_knots(random, degree);
  Points points = random_points(random, knots.num_points(), 3);
  return {std::move(knots), std::move(points)};
}

/// Returns quarters of a circle about (x, 0), from the angle -90 degrees on.
inline CurveNet circle_arcs(double x, double radius, int quarters) {
  std::vector<double> knots{0};
  for (int i = 0; i <= quarters; ++i) knots.insert(knots.end(), 2, i);
  knots.push_back(quarters);
  Points columns(2 * quarters + 1, 3);
  for (int i = 0; i <= 2 * quarters; ++i) {
    const double w = i % 2 == 0 ? 1 : cos_degrees(45), angle = -90 + 45 * i;
    columns.row(i) << w * x + radius * cos_degrees(angle), radius * sin_degrees(angle), w;
  }
  return {Knots<double>::open(2, 2 * quarters + 1, knots), columns, Coordinates::homogeneous};
}

/// Returns a point or derivative of the columns, computed in 256 bits by the recursion of Cox and de Boor.
inline Eigen::RowVectorXd truth(const CurveNet& curve, double t, int order = 0) {
  const Index p = curve.knots.degree();
  const Index k = curve.knots.span(curve.knots.place(t).face);
  const std::vector<Precise> knots(curve.knots.all().begin(), curve.knots.all().end());
  const std::vector<Precise> row = hodograph_row<Precise>(knots, p, k, order, Precise(t));
  Eigen::RowVectorXd value(curve.columns.cols());
  for (Eigen::Index c = 0; c < value.size(); ++c) {
    Precise sum = 0;
    for (size_t i = 0; i < row.size(); ++i) sum += row[i] * curve.columns(curve.knots.point(Index(i)), c);
    value[c] = static_cast<double>(sum);
  }
  return value;
}

/// Values of a patch at its own parameters, with derivatives per unit of these: rows x, du, dv, duu, duv, dvv;
/// normal.
struct OwnValues {
  Eigen::Matrix<double, 6, 3> x;
  Eigen::RowVector3d normal;
  LimitStatus status;
};
inline OwnValues own_values(const Patch& patch, const Points& columns, Coordinates coordinates, double u, double v) {
  const Place place = patch.place({u, v});
  const LimitSamples at = patch.evaluate(columns, std::span(&place, 1), 2, coordinates);
  const auto [a, b] = patch.lengths(place.face);
  OwnValues result;
  result.x << at.position, at.du / a, at.dv / b, at.duu / (a * a), at.duv / (a * b), at.dvv / (b * b);
  result.normal = at.normal.row(0);
  result.status = at.status[0];
  return result;
}
inline OwnValues own_values(const SplineNet& net, double u, double v) {
  return own_values(*net.surface, net.columns, net.coordinates, u, v);
}

/// Returns Gauss and mean curvature with respect to du x dv.
inline std::pair<double, double> curvatures(const OwnValues& at) {
  const Eigen::RowVector3d u = at.x.row(1), v = at.x.row(2), n = u.cross(v).normalized();
  const double E = u.dot(u), F = u.dot(v), G = v.dot(v);
  const double L = at.x.row(3).dot(n), M = at.x.row(4).dot(n), N = at.x.row(5).dot(n);
  const double area = E * G - F * F;
  return {(L * N - M * M) / area, (E * N - 2 * F * M + G * L) / (2 * area)};
}

inline void expect_near(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b, double tolerance) {
  ASSERT_EQ(a.rows(), b.rows());
  ASSERT_EQ(a.cols(), b.cols());
  EXPECT_LE((a - b).cwiseAbs().maxCoeff(), tolerance) << a << "\nand\n" << b;
}

/// Tolerance of sums of some dozens of terms of size 1 to 10 in another order.
inline constexpr double sums = 1e-13;
/// Tolerance of their second derivatives, of size 100.
inline constexpr double derivative_sums = 1e-11;

}  // namespace sublimit::testing
