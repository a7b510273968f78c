// SPDX-License-Identifier: Apache-2.0
// `implicit`: a control mesh of a field in one call.
#include "sublimit/stencils/recipes/implicit.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sublimit/limit/limit.h"
#include "support/expect_error.h"

namespace sublimit::testing {
namespace {

TEST(Implicit, FitsTheLimitToASphere) {
  const ImplicitMesh ball = implicit(R"json({"field": "sphere", "center": [1, 0, 0], "radius": 2})json",
                                     "catmull-clark", {.tolerance = 1e-2});
  EXPECT_TRUE(ball.met);
  EXPECT_EQ(ball.tolerance, 1e-2);
  EXPECT_LE(ball.largest_distance, 1e-2);
  EXPECT_GT(ball.mean_distance, 0);
  ASSERT_GT(ball.mesh.num_faces(), 0);
  const Limit limit = sublimit::limit(ball.mesh, "catmull-clark");
  for (Index v = 0; v < limit.points.rows(); ++v)
    EXPECT_LE(std::abs((limit.points.row(v) - Eigen::RowVector3d(1, 0, 0)).norm() - 2), 1e-2);
}

TEST(Implicit, RefusesWhatIsWrong) {
  const char* const field = R"json({"field": "sphere", "center": [0, 0, 0], "radius": 1})json";
  expect_error<InvalidParameter>([&] { (void)implicit(field, "catmull-clark", {.cells = 3}); }, {"cells is 3"});
  expect_error<InvalidParameter>([&] { (void)implicit(field, "catmull-clark", {.tolerance = -1}); }, {"tolerance"});
  expect_error<InvalidOption>([&] { (void)implicit(field, "catmul"); }, {"catmull-clark"});
  expect_error<FormatError>([&] { (void)implicit(R"json({"field": "spere"})json"); }, {"spere", "sphere"});
  expect_error<IoError>([&] { (void)implicit("there is no such.json"); }, {"there is no such.json"});
}

}  // namespace
}  // namespace sublimit::testing
