// SPDX-License-Identifier: Apache-2.0
// Refinement without matrices: the levels and the bits that matrices give, for every scheme.
#include "sublimit/scheme/refine_points.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "sublimit/base/error.h"
#include "sublimit/core/sparse_product.h"
#include "sublimit/schemes.h"
#include "support/expect_error.h"
#include "support/meshes.h"
#include "support/point_intervals.h"
#include "support/tolerance.h"

namespace sublimit::testing {
namespace {

void expect_same_level(const Level& own, const Level& other) {
  const Topology &a = own.topology(), &b = other.topology();
  EXPECT_EQ(own.number, other.number);
  ASSERT_EQ(a.num_faces(), b.num_faces());
  ASSERT_EQ(a.num_vertices(), b.num_vertices());
  for (Index i = 0; i < a.num_faces(); ++i)
    ASSERT_TRUE(std::ranges::equal(a.vertices(Face{i}), b.vertices(Face{i}))) << i;
  EXPECT_EQ(own.sharpness.edge, other.sharpness.edge);
  EXPECT_EQ(own.sharpness.vertex, other.sharpness.vertex);
  EXPECT_EQ(own.holes, other.holes);
  EXPECT_EQ(own.intervals.length, other.intervals.length);
}

/// What matrices make, or nothing where the scheme cannot take the mesh.
std::optional<RefinedPoints> by_matrices(const Scheme<double>& scheme, const ControlMesh& mesh, int levels) {
  try {
    std::vector<Level> all = refine(scheme, mesh, levels);
    Points points = mesh.positions;
    for (size_t k = 1; k < all.size(); ++k) points = apply(all[k].S, points);
    return RefinedPoints{std::move(all.back()), std::move(points)};
  } catch (const Error&) {
    return std::nullopt;
  }
}

TEST(RefinePoints, AreThoseOfTheMatricesForEveryScheme) {
  ControlMesh creased = cube();
  creased.creases = {{0, 1, 2.5f}, {1, 3, 10.f}, {3, 2, 1.f}};
  creased.corners = {{5, 1.5f}};
  ControlMesh holed = grid(4, 3);
  holed.holes = {5};
  ControlMesh box = cube();
  box.knot_intervals = {{0, 1, 1}, {0, 2, 2.5}, {0, 4, 4}};
  const std::vector<ControlMesh> meshes{jittered(cube()),
                                        jittered(octahedron()),
                                        jittered(torus(4, 5)),
                                        jittered(triangle_torus(4, 4)),
                                        jittered(prism(5)),
                                        jittered(open_fan(5, 3)),
                                        triangle_grid(3, 2),
                                        creased,
                                        holed,
                                        box,
                                        with_point_intervals(octahedron(), 3)};
  int compared = 0, refused = 0;
  for (const Scheme<double>& scheme : all_schemes())
    for (size_t i = 0; i < meshes.size(); ++i) {
      SCOPED_TRACE(scheme.name + ", mesh " + std::to_string(i));
      const std::optional<RefinedPoints> expected = by_matrices(scheme, meshes[i], 2);
      if (!expected) {
        EXPECT_THROW(refine_points(scheme, meshes[i], 2), Error);
        ++refused;
        continue;
      }
      const RefinedPoints own = refine_points(scheme, meshes[i], 2);
      expect_same_level(own.level, expected->level);
      const double difference = (own.points - expected->points).cwiseAbs().maxCoeff();
      // Steps one after the other round otherwise than their product.
      EXPECT_LE(difference, scheme.steps.size() == 1 && scheme.preparation.empty() ? 0 : rounding(64));
      ++compared;
    }
  EXPECT_GT(compared, 100);
  EXPECT_GT(refused, 0);
}

TEST(RefinePoints, DoNotDependOnThreadsAndTakeAnyColumns) {
  const Scheme<double> scheme = *find_scheme("catmull-clark");
  const ControlMesh mesh = jittered(torus(30, 20));
  const RefinedPoints many = refine_points(scheme, mesh, 2);
  {
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    EXPECT_EQ((refine_points(scheme, mesh, 2).points - many.points).norm(), 0);
  }
  Points columns(mesh.num_vertices(), 5);
  columns << mesh.positions, mesh.positions.leftCols(2);
  const Points five = refine_points(scheme, control_level(scheme, mesh), columns, 2).points;
  EXPECT_EQ((five.leftCols(3) - many.points).norm(), 0);
  EXPECT_EQ((five.rightCols(2) - many.points.leftCols(2)).norm(), 0);
}

TEST(RefinePoints, SayWhatIsWrong) {
  const Scheme<double> scheme = *find_scheme("catmull-clark");
  expect_error<InvalidParameter>([&] { refine_points(scheme, cube(), -1); }, {"levels is -1"});
  expect_error<InvalidParameter>([&] { refine_points(scheme, control_level(scheme, cube()), Points::Zero(7, 3), 1); },
                                 {"8 vertices", "7 points"});
  expect_error<ResourceError>([&] { refine_points(scheme, cube(), 30); }, {"30 levels", "32-bit"});
  std::vector<int> told;
  refine_points(scheme, cube(), 3, {}, [&](int level) { told.push_back(level); });
  EXPECT_EQ(told, (std::vector<int>{1, 2, 3}));
}

}  // namespace
}  // namespace sublimit::testing
