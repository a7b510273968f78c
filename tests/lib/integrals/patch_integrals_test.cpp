// SPDX-License-Identifier: Apache-2.0
// Integrals over classical patches, by closed forms and by limits that are the same surface.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "meshes/free_form_shapes.h"
#include "sublimit/base/error.h"
#include "sublimit/integrals/limit_integrals.h"
#include "sublimit/patches/patches.h"
#include "support/expect_error.h"
#include "support/tolerance.h"

namespace sublimit::testing {
namespace {

constexpr double pi = std::numbers::pi;
/// Tolerance of areas and volumes near 10: cells are quartered until they change by 2e-13, a hundredth of it.
constexpr double quartered = 1e-11;

Patches patches_of(RationalShape shape) {
  return {PatchSet({std::make_shared<const SplineSurface>(std::move(shape.surface))}, Coordinates::homogeneous),
          std::move(shape.columns)};
}
/// Moved by (x, y, z) and scaled.
Patches placed(RationalShape shape, const Eigen::RowVector3d& by, double scale) {
  shape.columns.leftCols(3) = scale * (shape.columns.leftCols(3) + shape.columns.col(3) * by);
  return patches_of(std::move(shape));
}

TEST(PatchIntegrals, OfASphere) {
  for (const double scale : {1e-3, 1.0, 1e4}) {
    SCOPED_TRACE(scale);
    const LimitIntegrals found = limit_integrals(placed(unit_sphere(), {1, 2, 3}, scale));
    EXPECT_NEAR(found.area, 4 * pi * scale * scale, quartered * scale * scale);
    ASSERT_TRUE(found.solid) << found.why_no_solid;
    EXPECT_NEAR(found.solid->volume, 4 * pi / 3 * std::pow(scale, 3), quartered * std::pow(scale, 3));
    EXPECT_LE((found.solid->centroid - scale * Eigen::Vector3d(1, 2, 3)).norm(), quartered * scale);
    const double inertia = 8 * pi / 15 * std::pow(scale, 5);
    EXPECT_LE((found.solid->inertia - inertia * Eigen::Matrix3d::Identity()).norm(), quartered * std::pow(scale, 5));
  }
}

TEST(PatchIntegrals, OfATorus) {
  const LimitIntegrals found = limit_integrals(patches_of(torus()));  // radii 3 and 1
  EXPECT_NEAR(found.area, 4 * pi * pi * 3, 100 * quartered);
  ASSERT_TRUE(found.solid) << found.why_no_solid;
  EXPECT_NEAR(found.solid->volume, 2 * pi * pi * 3, 100 * quartered);
  EXPECT_LE(found.solid->centroid.norm(), 100 * quartered);
}

TEST(PatchIntegrals, OfAnOpenPipe) {
  const LimitIntegrals found = limit_integrals(patches_of(pipe()));  // of radius 1/2 and length 4
  EXPECT_NEAR(found.area, 4 * pi, quartered);
  EXPECT_FALSE(found.solid);
  EXPECT_NE(found.why_no_solid.find("no other one's"), std::string::npos) << found.why_no_solid;
  ASSERT_TRUE(found.centroid);
  EXPECT_LE((*found.centroid - Eigen::Vector3d(2, 0, 0)).norm(), quartered);
}

// The estimate of the error is not below the error.
TEST(PatchIntegrals, ErrorsAreBounded) {
  const LimitIntegrals found = limit_integrals(patches_of(torus()));
  const double rounding_of_sums = 1e-13 * found.area;
  EXPECT_LE(std::abs(found.area - 12 * pi * pi), found.area_error + rounding_of_sums);
  EXPECT_LE(std::abs(found.solid->volume - 6 * pi * pi), found.solid->volume_error + rounding_of_sums);
}

TEST(PatchIntegrals, SayWhatHasNone) {
  RationalShape shape = unit_sphere();
  shape.columns(0, 0) = std::nan("");
  expect_error<InvalidMesh>([&] { (void)limit_integrals(patches_of(shape)); }, {"not finite"});
  RationalShape with_pole = pipe();
  with_pole.columns.row(4) *= -1;
  expect_error<UnsupportedTopology>([&] { (void)limit_integrals(patches_of(with_pole)); },
                                    {"face 1, of patch 0", "denominator"});
}

}  // namespace
}  // namespace sublimit::testing
