// SPDX-License-Identifier: Apache-2.0
// Clouds near classical patches.
#include <gtest/gtest.h>

#include <random>

#include "meshes/construction_data.h"
#include "meshes/free_form_shapes.h"
#include "sublimit/fit/cloud_fit.h"
#include "support/expect_error.h"
#include "support/tolerance.h"

namespace sublimit::testing {
namespace {

/// Distances that a fit comes down to where there is a surface through all points.
constexpr double fitted = 1e-5;

// Points on a bump of patches; the plane that the fit starts from comes to them.
TEST(PatchCloud, FindsTheSurfaceThatPointsAreOn) {
  std::mt19937 random(3);
  const auto spline = std::make_shared<const SplineSurface>(uniform_knots(3, 6), uniform_knots(2, 5));
  Points plane(30, 3);
  for (Index j = 0; j < 5; ++j)
    for (Index i = 0; i < 6; ++i) plane.row(6 * j + i) << i, j, 0;
  Points bump = plane;
  bump.col(2) = 0.3 * random_points(random, 30, 1);
  const Patches truth(PatchSet({spline}), bump), start(PatchSet({spline}), plane);
  const Cloud cloud{truth.evaluate(truth.grid(9)).position, {}};
  const CloudFit found = fit_cloud(start, cloud);
  EXPECT_GT(found.iterations.front().rms, 0.01);
  EXPECT_LE(found.iterations.back().rms, fitted);
  for (size_t k = 1; k < found.iterations.size(); ++k)
    EXPECT_LE(found.iterations[k].energy, found.iterations[k - 1].energy);
  const Points again = start.with(found.points).evaluate(found.foot_points.places).position;
  EXPECT_LE((again - found.foot_points.points).rowwise().norm().maxCoeff(), other_route * 10);
}

// The limit of a mesh and the same surface as patches take the same steps.
TEST(PatchCloud, IsTheFitOfTheLimitWhichIsTheSameSurface) {
  std::mt19937 random(4);
  const Index n = 6;
  Mesh grid;
  grid.positions.resize(n * n, 3);
  for (Index j = 0; j < n; ++j)
    for (Index i = 0; i < n; ++i) grid.positions.row(j * n + i) << i, j, 0;
  for (Index j = 0; j + 1 < n; ++j)
    for (Index i = 0; i + 1 < n; ++i) {
      const Index a = j * n + i;
      grid.face_sizes.push_back(4);
      for (const Index v : {a, a + 1, a + n + 1, a + n}) grid.face_vertices.push_back(v);
    }
  grid.boundary = Boundary::none;
  const auto spline = std::make_shared<const SplineSurface>(uniform_knots(3, n), uniform_knots(3, n));
  Points bump = grid.positions;
  bump.col(2) = 0.2 * random_points(random, n * n, 1);
  const Patches truth(PatchSet({spline}), bump), start(PatchSet({spline}), grid.positions);
  const Cloud cloud{truth.evaluate(truth.grid(8)).position, {}};
  const LimitSurface limit(grid, "catmull-clark");
  const CloudFitOptions options{.iterations = 5};
  const CloudFit of_patches = fit_cloud(start, cloud, options),
                 of_limit = fit_cloud(limit.map(), cloud, limit.points(), options);
  ASSERT_EQ(of_patches.iterations.size(), of_limit.iterations.size());
  for (size_t k = 0; k < of_patches.iterations.size(); ++k)
    EXPECT_NEAR(of_patches.iterations[k].rms, of_limit.iterations[k].rms, found_distance) << k;
}

// Weights stay: a sphere of another size is met by control points alone.
TEST(PatchCloud, KeepsWeightsOfRationalPatches) {
  const RationalShape sphere = unit_sphere();
  const PatchSet set({std::make_shared<const SplineSurface>(sphere.surface)}, Coordinates::homogeneous);
  const Patches start(set, sphere.columns);
  std::mt19937 random(5);
  Cloud cloud{random_points(random, 200, 3), {}};
  cloud.points.rowwise().normalize();
  cloud.points *= 1.25;
  const CloudFit found = fit_cloud(start, cloud);
  EXPECT_NEAR(found.iterations.front().rms, 0.25, found_distance);
  EXPECT_LE(found.iterations.back().rms, fitted);
  EXPECT_EQ(found.points.col(3), sphere.columns.col(3));
}

}  // namespace
}  // namespace sublimit::testing
