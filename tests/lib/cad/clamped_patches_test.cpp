// SPDX-License-Identifier: Apache-2.0
#include "sublimit/cad/clamped_patches.h"

#include <gtest/gtest.h>

#include <random>

#include "meshes/spline_models.h"
#include "sublimit/cad/triangle_thirds.h"
#include "sublimit/patches/constructions/gregory_patch.h"
#include "sublimit/patches/constructions/screw_surface.h"
#include "sublimit/patches/constructions/triangle_patch.h"
#include "support/expect_error.h"
#include "support/tolerance.h"

namespace sublimit {
namespace {

using testing::cad_exact;
using testing::expect_error;

Points random_columns(std::mt19937& random, Index count) {
  Points columns(count, 3);
  for (Index i = 0; i < count; ++i)
    for (int c = 0; c < 3; ++c) columns(i, c) = std::uniform_real_distribution<>(-1, 1)(random);
  return columns;
}

Eigen::RowVector3d point(const Patch& patch, const Points& columns, double u, double v,
                         Coordinates coordinates = Coordinates::plain) {
  const Place at = patch.place({.u = u, .v = v});
  return patch.evaluate(columns, {&at, 1}, 0, coordinates).position.row(0);
}

TEST(TriangleThirds, AreConvexCombinations) {
  for (const int degree : {1, 2, 3, 5, 9})
    for (const Eigen::MatrixXd& third : triangle_thirds(degree)) {
      EXPECT_GE(third.minCoeff(), 0);
      EXPECT_LT((third.rowwise().sum().array() - 1).abs().maxCoeff(), cad_exact);
    }
}

TEST(ClampedPatches, ThirdsAreTheTriangle) {
  std::mt19937 random(1);
  for (const int degree : {1, 2, 3, 4, 7, 12})
    for (const int level : {0, 1}) {
      const auto triangle = std::make_shared<const TrianglePatch>(degree, level);
      const NamedPatch source{triangle, random_columns(random, triangle->num_points())};
      const ClampedPatches made = clamped_patches({&source, 1});
      ASSERT_EQ(made.patches.size(), level == 0 ? 3u : 12u);
      // Its third k starts at corner k, goes to the middle of the next side, to the middle, and back.
      const double corners[3][2] = {{0, 0}, {1, 0}, {0, 1}};
      for (size_t k = 0; k < 3 && level == 0; ++k)
        for (const double s : {0.0, 0.3, 1.0})
          for (const double t : {0.0, 0.6, 1.0}) {
            double at[2];
            for (int c = 0; c < 2; ++c) {
              const double own = corners[k][c], next = corners[(k + 1) % 3][c], last = corners[(k + 2) % 3][c];
              at[c] = (1 - s) * (1 - t) * own + s * (1 - t) * (own + next) / 2 + s * t * (own + next + last) / 3 +
                      (1 - s) * t * (own + last) / 2;
            }
            const Eigen::RowVector3d right = point(*triangle, source.columns, at[0], at[1]);
            EXPECT_LT((point(made.patches[k].surface, made.patches[k].columns, s, t) - right).norm(), cad_exact);
          }
    }
}

TEST(ClampedPatches, KeepClampedNetsBitForBit) {
  const testing::SplineModel sphere = testing::nurbs_sphere();
  const NamedPatch source{std::make_shared<const SplineSurface>(sphere.surfaces[0]), sphere.columns[0],
                          Coordinates::homogeneous};
  const ClampedPatches made = clamped_patches({&source, 1});
  EXPECT_EQ(made.patches[0].columns, sphere.columns[0]);
}

TEST(ClampedPatches, WeightsThatAreNotPositiveBecomeSo) {
  // Half a circle by a control point at infinity, and by weights below 0.
  const Knots<double> quadratic = bezier_knots<double>(2), linear = bezier_knots<double>(1);
  Points columns(6, 4);
  columns << 1, 0, 0, 1, 0, 1, 0, 0, -1, 0, 0, 1, 1, 0, 1, 1, 0, 1, 0, 0, -1, 0, 1, 1;
  for (const double sign : {1.0, -1.0}) {
    const NamedPatch source{std::make_shared<const SplineSurface>(quadratic, linear), sign * columns,
                            Coordinates::homogeneous};
    const ClampedPatches made = clamped_patches({&source, 1});
    EXPECT_GT(made.patches[0].columns.col(3).minCoeff(), 0);
    for (const double u : {0.0, 0.2, 0.5, 0.9})
      EXPECT_NEAR(
          point(made.patches[0].surface, made.patches[0].columns, u, 0.5, Coordinates::homogeneous).head(2).norm(), 1,
          cad_exact);
  }
}

TEST(ClampedPatches, RefuseWhatCadFilesDoNotHave) {
  const auto refused = [](std::shared_ptr<const Patch> patch, const Points& columns, Coordinates coordinates,
                          std::initializer_list<std::string_view> words) {
    const NamedPatch source{std::move(patch), columns, coordinates, "", "m.obj:7: patch 3", "it turns"};
    expect_error<UnsupportedTopology>([&] { clamped_patches({&source, 1}); }, words);
  };
  const auto screw = std::make_shared<const ScrewSurface>(bezier_knots<double>(1), 0, 3);
  refused(screw, Points::Random(screw->num_points(), 3), Coordinates::plain,
          {"m.obj:7: patch 3", "no B-spline", "it turns", "leave it out"});
  const auto gregory = std::make_shared<const GregoryPatch>(
      SplineSurface(bezier_knots<double>(3), bezier_knots<double>(3)), std::array{true, false, false, false});
  refused(gregory, Points::Random(gregory->num_points(), 3), Coordinates::plain, {"m.obj:7: patch 3", "no B-spline"});
  const auto constant = std::make_shared<const SplineSurface>(bezier_knots<double>(0), bezier_knots<double>(1));
  refused(constant, Points::Random(2, 3), Coordinates::plain, {"m.obj:7: patch 3", "degree 0"});
  Points pole = Points::Ones(4, 4);
  pole(0, 3) = -1;
  const auto bilinear = std::make_shared<const SplineSurface>(bezier_knots<double>(1), bezier_knots<double>(1));
  refused(bilinear, pole, Coordinates::homogeneous, {"m.obj:7: patch 3", "denominator", "weights above 0"});
}

}  // namespace
}  // namespace sublimit
