// SPDX-License-Identifier: Apache-2.0
#include "sublimit/geometric/nielson.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "meshes/normal_triangles.h"
#include "support/tolerance.h"

namespace sublimit::testing {
namespace {

using Eigen::Vector3d;
using std::numbers::pi;

/// Of patches of size 1: some hundred operations.
constexpr double patch_rounding = 1e-13, precise_rounding = 1e-70;
/// Planes along edges: normals are of derivatives, which have cancelled a digit.
constexpr double common_plane = 1e-13, precise_plane = 1e-40;
/// Of second derivatives, of size 10.
constexpr double second_rounding = 1e-11;

TEST(Nielson, GoesThroughPointsWithNormalsAlongEdgeCubics) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    const auto corners = random_corners(seed);
    expect_interpolation<NielsonPatch>(triangle<double>(corners), patch_rounding);
    if (seed < 3) expect_interpolation<NielsonPatch>(triangle<Precise>(corners), precise_rounding);
  }
}

TEST(Nielson, NeighboursTouchTheSamePlanes) {
  for (unsigned seed = 0; seed < 10; ++seed)
    expect_common_planes<NielsonPatch, double>(random_corners(seed), common_plane);
  for (unsigned seed = 0; seed < 2; ++seed)
    expect_common_planes<NielsonPatch, Precise>(random_corners(seed), precise_plane);
}

TEST(Nielson, DerivativesAreThoseOfPositions) {
  for (unsigned seed = 0; seed < 3; ++seed)
    expect_true_derivatives<NielsonPatch>(triangle<Precise>(random_corners(seed)),
                                          {{0.25, 0.25}, {0.3, 0.6}, {0.05, 0.9}, {1.0 / 3, 1.0 / 3}, {0.5, 0.125}});
}

TEST(Nielson, DoublesAreAsGoodAs256Bits) {
  for (unsigned seed = 0; seed < 5; ++seed) {
    const auto corners = random_corners(seed);
    for (int i = 0; i <= 8; ++i)
      for (int j = 0; i + j <= 8; ++j)
        expect_precise_values<NielsonPatch>(corners, i / 8.0, j / 8.0, patch_rounding, second_rounding);
    // Near corners first derivatives stay as good, and second ones lose digits in proportion.
    for (const double r : {1e-3, 1e-6, 1e-9}) {
      expect_precise_values<NielsonPatch>(corners, r, r / 2, patch_rounding, 100 * eps / r);
      expect_precise_values<NielsonPatch>(corners, 1 - 2 * r, r, patch_rounding, 100 * eps / r);
      expect_precise_values<NielsonPatch>(corners, 0, r, patch_rounding, 100 * eps / r);
    }
  }
}

TEST(Nielson, MovesWithItsData) {
  for (unsigned seed = 0; seed < 10; ++seed) expect_no_preference<NielsonPatch>(random_corners(seed), patch_rounding);
}

TEST(Nielson, PlanesArePlane) { expect_plane<NielsonPatch>(random_corners(1)); }

TEST(Nielson, IsNearSpheres) {
  const Vector3d x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
  const auto middle = [](const Vector3d& a, const Vector3d& b) { return Vector3d((a + b).normalized()); };
  constexpr double three_digits = 5e-6;  // half of the last digit of each figure
  constexpr double last_digit = 5e-7;
  EXPECT_NEAR(distance_from_sphere<NielsonPatch>(on_sphere(x, y, z)), 3.58e-3, three_digits);
  // Quarters of the octant: two edges of 45 degrees and one of 60, three of 60.
  EXPECT_NEAR(distance_from_sphere<NielsonPatch>(on_sphere(x, middle(x, y), middle(x, z))), 5.3e-5, last_digit);
  EXPECT_NEAR(distance_from_sphere<NielsonPatch>(on_sphere(middle(x, y), middle(y, z), middle(z, x))), 1.94e-4,
              last_digit);
}

TEST(Nielson, CornersHaveFirstDerivativesOnly) {
  const NielsonPatch<double> patch = patch_of<NielsonPatch>(triangle<double>(random_corners(2)));
  for (int i = 0; i < 3; ++i) {
    const auto [u, v] = corner_place<double>(i);
    const PatchPoint<double> corner = patch.at(u, v);
    EXPECT_EQ(corner.status, LimitStatus::unbounded_second);
    EXPECT_EQ(corner.order, 1);
    EXPECT_TRUE(corner.duu.isZero(0));
    EXPECT_EQ(patch.at(u, v, 1).status, LimitStatus::crease);
    EXPECT_EQ(patch.at(u, v, 0).status, LimitStatus::regular);
    // First derivatives tend to those of the corner, second ones depend on where they come from.
    std::array<Vector3d, 2> second;
    for (int way = 0; way < 2; ++way) {
      const double r = 1e-5, p = u + r * ((way == 0 ? 0.5 : 0.1) - u), q = v + r * ((way == 0 ? 0.25 : 0.6) - v);
      const PatchPoint<double> near = patch.at(p, q);
      EXPECT_EQ(near.status, LimitStatus::regular);
      EXPECT_LE((near.du - corner.du).norm() + (near.dv - corner.dv).norm(), 100 * r);
      second[way] = near.duv;
    }
    EXPECT_GT((second[0] - second[1]).norm(), 1e-2);
  }
}

TEST(Nielson, StatusSaysWhatThereIs) {
  const NielsonPatch<double> patch = patch_of<NielsonPatch>(triangle<double>(random_corners(4)));
  EXPECT_EQ(patch.at(0.25, 0.25).status, LimitStatus::regular);
  EXPECT_EQ(patch.at(0.25, 0.25).order, 2);
  EXPECT_EQ(patch.at(0.25, 0.25, 0).order, 0);
  for (const auto& [u, v] : {std::pair(0.5, 0.0), std::pair(0.0, 0.25), std::pair(0.3, 0.7)}) {
    EXPECT_EQ(patch.at(u, v).status, LimitStatus::crease);
    EXPECT_EQ(patch.at(u, v).order, 2);
    EXPECT_EQ(patch.at(u, v, 0).status, LimitStatus::regular);
  }
  // A flat corner of 180 degrees: the edges' tangents are parallel there.
  const Vector3d up(0, 0, 1);
  const NielsonPatch<double> flat({Vector3d(0, 0, 0), Vector3d(1, 0, 0), Vector3d(-1, 0, 0)}, {up, up, up});
  EXPECT_EQ(flat.at(0, 0).status, LimitStatus::undefined_normal);
  EXPECT_EQ(flat.at(0, 0).order, 1);
  EXPECT_TRUE(flat.at(0, 0).normal.isZero(0));
}

// Normals that turn over along an edge, in the plane of its curve, run along the curve somewhere: a side has points
// there, and the inside beside it none.
TEST(Nielson, SaysWhereAnEdgeHasNoNormal) {
  const Vector3d a(0, 0, 0), b(1, 0, 0), c(0.5, 1, 0);
  const NielsonPatch<double> patch(
      {a, b, c}, {Vector3d(-1, 0, 1).normalized(), Vector3d(-1, 0, -1).normalized(), Vector3d(0, 0, 1)});
  const PatchPoint<double> side = patch.at(0.5, 0, 2), inside = patch.at(0.25, 0.5, 2);
  EXPECT_EQ(side.status, LimitStatus::undefined_normal);
  EXPECT_EQ(side.order, 0);
  EXPECT_NEAR(side.position.x(), 0.5, rounding(8));
  EXPECT_EQ(inside.status, LimitStatus::pole);
  EXPECT_TRUE(inside.position.isZero(0));
}

}  // namespace
}  // namespace sublimit::testing
