// SPDX-License-Identifier: Apache-2.0
#include "sublimit/geometric/torus_carrier.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <array>
#include <cmath>

#include "sublimit/geometric/torus_edge.h"
#include "support/tolerance.h"

namespace sublimit::testing {
namespace {

using Eigen::Matrix3d, Eigen::Vector3d;

/// A cubic polynomial in the plane, a millionth high, so that squares of its slopes are rounding.
constexpr double height = 1e-6, squares = 1e-5;
SurfacePoint on_cubic(double x, double y) {
  const double z =
      0.3 + x - 2 * y + x * x - 3 * x * y + 0.5 * y * y + 2 * x * x * x - x * x * y + 3 * x * y * y - y * y * y;
  const double zx = 1 + 2 * x - 3 * y + 6 * x * x - 2 * x * y + 3 * y * y;
  const double zy = -2 - 3 * x + y - x * x + 6 * x * y - 3 * y * y;
  Matrix3d second = Matrix3d::Zero();
  second(0, 0) = 2 + 12 * x - 2 * y;
  second(0, 1) = second(1, 0) = -3 - 2 * x + 6 * y;
  second(1, 1) = 1 + 6 * x - 6 * y;
  return surface_point({x, y, height * z}, Vector3d(-height * zx, -height * zy, 1).normalized(), height * second);
}

TEST(TorusCarrier, MeetsCubicPolynomials) {
  const SurfacePoint a = on_cubic(-0.3, 0.2), b = on_cubic(0.5, -0.4), c = on_cubic(0.4, 0.5), d = on_cubic(-0.2, -0.6),
                     truth = on_cubic(0.1, -0.1);
  // Flat pieces: the rule alone.
  const TorusPiece piece(a.position, a.direction1, a.normal, a.k1, a.k2, 0);
  for (const double skew : {0.0, -0.8}) {
    const TorusCarrier::Middle middle = TorusCarrier::make(piece, b, skew)->middle(truth.position).value();
    EXPECT_LT((middle.position - truth.position).norm(), squares * height);
    EXPECT_LT((middle.normal - truth.normal).norm(), squares * height);
    EXPECT_LT((middle.shape - truth.shape()).norm(), squares * height);
  }
  // The whole edge; pieces with g are as exact, up to their terms of order four.
  const std::array<const SurfacePoint*, 2> opposite{&c, &d};
  const SurfacePoint middle = torus_edge(a, b, opposite).point;
  EXPECT_LT((middle.position - truth.position).norm(), 0.02 * height);
}

/// From a sphere to a point off it by w, with the normal and curvatures of the sphere there that has the same centre:
/// slope and second derivative vanish at the far end, and half way the second derivative along, 3/2 w' - 1/4 w''.
TEST(TorusCarrier, KnowsTheCurvatureOfOffsets) {
  const double k = 0.8, w = 0.05, angle = 0.7;
  const Vector3d n(0, 0, 1), e1(1, 0, 0), centre(0, 0, 1 / k);
  const Vector3d far_normal(-std::sin(angle), 0, std::cos(angle));
  const double radius = 1 / k - w;
  const SurfacePoint far{centre - radius * far_normal, far_normal, 1 / radius, 1 / radius, Vector3d::UnitY()};
  const TorusPiece sphere(Vector3d::Zero(), e1, n, k, k, 0);
  const TorusCarrier carrier = TorusCarrier::make(sphere, far).value();
  EXPECT_NEAR(carrier.misfit2(), (w / far.position.norm()) * (w / far.position.norm()), reference);
  const Vector3d half(-std::sin(angle / 2), 0, std::cos(angle / 2));
  const TorusCarrier::Middle middle = carrier.middle(centre - half / k).value();
  EXPECT_LT((middle.position - (centre - (1 / k - w / 2) * half)).norm(), reference);
  const SurfacePoint at = surface_point(middle.position, middle.normal, middle.shape);
  const double slope = std::tan(std::acos(middle.normal.dot(half))) * (1 - k * w / 2);  // of the height, by length
  EXPECT_GT(slope, 2 * w);  // 9/4 w by the edge's length, below 1
  const TorusCarrier again = TorusCarrier::make(sphere, at).value();
  const double h = at.position.norm();
  EXPECT_NEAR(again.misfit2(), w / 2 / h * (w / 2 / h) + slope * slope, reference);  // no second derivative
}

}  // namespace
}  // namespace sublimit::testing
