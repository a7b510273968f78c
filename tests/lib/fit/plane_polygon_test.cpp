// SPDX-License-Identifier: Apache-2.0
#include "sublimit/fit/detail/plane_polygon.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <numbers>

#include "support/tolerance.h"

namespace sublimit::testing {
namespace {

using Eigen::Vector3d;

/// Masks of a face of a dual scheme: the centroid, cosines and sines.
PlanePolygon with_masks(const Eigen::MatrixX3d& corners) {
  const Eigen::Index n = corners.rows();
  PlanePolygon polygon{.corners = corners, .weights = Eigen::MatrixX3d(n, 3)};
  for (Eigen::Index i = 0; i < n; ++i) {
    const double angle = 2 * std::numbers::pi * double(i) / double(n);
    polygon.weights.row(i) << 1 / double(n), std::cos(angle), std::sin(angle);
  }
  return polygon;
}

Vector3d normal_of(const PlanePolygon& polygon) {
  const Vector3d t1 = polygon.corners.transpose() * polygon.weights.col(1);
  return t1.cross(Vector3d(polygon.corners.transpose() * polygon.weights.col(2))).normalized();
}

TEST(PlanePolygon, IsTurnedTheShortestWay) {
  // A square in the xy plane, with its normal tilted towards x: lengths along y stay.
  PlanePolygon polygon = with_masks(Eigen::MatrixX3d{{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}});
  EXPECT_EQ(turn_across(polygon, {2, 0, 2}, 3), OrientationResult::plain);
  const double r = 3 / std::numbers::sqrt2;
  const Eigen::MatrixX3d expected{{r, 0, -r}, {0, 3, 0}, {-r, 0, r}, {0, -3, 0}};
  EXPECT_LE((polygon.corners - expected).cwiseAbs().maxCoeff(), rounding(8, 3));
}

TEST(PlanePolygon, IsPlaneAfterwardsWhateverItsCornersWere) {
  PlanePolygon polygon = with_masks(Eigen::MatrixX3d{{1, 0, 1}, {0, 1, -1}, {-1, 0, 1}, {0, -1, -1}});
  EXPECT_EQ(turn_across(polygon, Vector3d::UnitZ()), OrientationResult::plain);
  const Eigen::MatrixX3d expected{{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}};
  EXPECT_LE((polygon.corners - expected).cwiseAbs().maxCoeff(), rounding(8));
}

TEST(PlanePolygon, IsTurnedOverWhereItsNormalIsOpposite) {
  PlanePolygon polygon = with_masks(Eigen::MatrixX3d{{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}});
  EXPECT_EQ(turn_across(polygon, -Vector3d::UnitZ()), OrientationResult::over);
  EXPECT_LE((normal_of(polygon) + Vector3d::UnitZ()).norm(), rounding(8));
}

TEST(PlanePolygon, IsRegularAndTurnedAsItsCornersLieWhereItHasNoPlane) {
  for (const double sign : {1.0, -1.0}) {  // corners to the right and to the left on a line
    PlanePolygon polygon = with_masks(Eigen::MatrixX3d{{5, 1, 0}, {5, 0, 0}, {5, -1, 0}, {5, 0, 0}});
    EXPECT_EQ(turn_across(polygon, sign * Vector3d::UnitZ()), OrientationResult::rebuilt);
    const double r = 0.5;  // the mean distance
    const Eigen::MatrixX3d expected{{5, r, 0}, {5 - sign * r, 0, 0}, {5, -r, 0}, {5 + sign * r, 0, 0}};
    EXPECT_LE((polygon.corners - expected).cwiseAbs().maxCoeff(), rounding(8, 5));
    EXPECT_LE((normal_of(polygon) - sign * Vector3d::UnitZ()).norm(), rounding(32, 5));
  }
}

TEST(PlanePolygon, OfThreeCornersOnALineIsTurnedTowardsThem) {
  PlanePolygon polygon = with_masks(Eigen::MatrixX3d{{1, 0, 0}, {0, 0, 0}, {-1, 0, 0}});
  EXPECT_EQ(turn_across(polygon, Vector3d::UnitZ()), OrientationResult::rebuilt);
  const double r = 2.0 / 3, half = r / 2, across = r * std::numbers::sqrt3 / 2;
  const Eigen::MatrixX3d expected{{across, -half, 0}, {0, r, 0}, {-across, -half, 0}};
  EXPECT_LE((polygon.corners - expected).cwiseAbs().maxCoeff(), rounding(8));
}

TEST(PlanePolygon, IsRegularWhereATangentVanishes) {  // a border edge from a vertex to itself
  PlanePolygon polygon = with_masks(Eigen::MatrixX3d{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 0}});
  polygon.weights.col(0) << 0.5, 0, 0, 0.5;
  polygon.weights.col(1) << 0.5, 0, 0, -0.5;
  EXPECT_EQ(turn_across(polygon, Vector3d::UnitZ()), OrientationResult::rebuilt);
  EXPECT_NEAR(normal_of(polygon).dot(Vector3d::UnitZ()), 1, rounding(8));
}

TEST(PlanePolygon, CannotBeTurnedIfItIsAPoint) {
  PlanePolygon polygon = with_masks(Eigen::MatrixX3d{{1, 2, 3}, {1, 2, 3}, {1, 2, 3}});
  EXPECT_EQ(turn_across(polygon, Vector3d::UnitZ()), OrientationResult::impossible);
}

TEST(PlanePolygon, MovesItsLimit) {
  PlanePolygon polygon = with_masks(Eigen::MatrixX3d{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}});
  move_to(polygon, {3, 2, 1});
  EXPECT_LE((polygon.corners.colwise().mean() - Eigen::RowVector3d(3, 2, 1)).norm(), rounding(8, 3));
}

}  // namespace
}  // namespace sublimit::testing
