// SPDX-License-Identifier: Apache-2.0
// A plan counts what the bake makes, to the byte, of wide masks at most; tables by rows it estimates.
#include <gtest/gtest.h>

#include "meshes/meshes.h"
#include "sublimit/base/error.h"
#include "sublimit/schemes/schemes.h"
#include "sublimit/stencils/bake/detail/bake.h"
#include "support/expect_error.h"

namespace sublimit::testing {
namespace {

void expect_counted(const std::string& name, const Mesh& mesh, const BakeRequest& request) {
  SCOPED_TRACE(name + ", rows " + sublimit::name(request.rows) + ", level " + std::to_string(request.level));
  Patterns patterns(find_scheme(name).value()), fresh(find_scheme(name).value());
  const BakeStatistics planned = bake_plan(patterns, mesh, request).statistics;
  const BakeStatistics made = bake(fresh, mesh, request).statistics;
  const bool is_wide = !patterns.scheme().has_one_ring_limits();
  EXPECT_NE(made.method, BakeMethod::rows);
  EXPECT_EQ(planned.method, made.method);
  EXPECT_EQ(planned.faces, made.faces);
  EXPECT_EQ(planned.types, made.types);
  EXPECT_EQ(planned.blocks, made.blocks);
  EXPECT_EQ(planned.groups, made.groups);
  EXPECT_EQ(planned.points, made.points);
  EXPECT_GE(planned.weights, made.weights);
  EXPECT_GE(planned.bytes, made.bytes);
  if (is_wide) return;  // patterns see more points than they use
  EXPECT_EQ(planned.weights, made.weights);
  EXPECT_EQ(planned.bytes, made.bytes);
}

TEST(BakePlan, CountsTablesByPatterns) {
  Mesh mixed = jittered(disjoint_union(prism(5), grid(4, 3)));
  mixed.creases = {{0, 1, 2}};
  mixed.holes = {1};
  Mesh alone = torus(8, 6);
  alone.positions.conservativeResize(alone.positions.rows() + 2, 3);
  alone.positions.bottomRows(2).setZero();
  for (const Mesh& mesh : {cube(), mixed, alone}) {
    for (const int level : {2, 3}) expect_counted("catmull-clark", mesh, {.level = level});
    for (const int derivatives : {0, 1, 2})
      expect_counted("catmull-clark", mesh, {.rows = TableRows::limit, .level = 2, .derivatives = derivatives});
    expect_counted("catmull-clark", mesh, {.rows = TableRows::grid, .grid = 4, .derivatives = 1});
  }
  for (const Mesh& mesh : {cube(), alone}) expect_counted("catmull-clark", mesh, {.level = 1});
  expect_counted("loop", icosahedron(), {.level = 3});
  expect_counted("butterfly", triangle_torus(6, 7), {.level = 2});
  expect_counted("sqrt3", icosahedron(), {.level = 4});
  for (const Mesh& mesh : {cube(), jittered(grid(4, 3))}) {
    expect_counted("doo-sabin", mesh, {.level = 3});
    expect_counted("mid-edge", mesh, {.rows = TableRows::limit, .level = 2});
    expect_counted("doo-sabin", mesh, {.rows = TableRows::grid, .grid = 5, .derivatives = 1});
  }
}

TEST(BakePlan, EstimatesTablesByRows) {
  Patterns patterns(find_scheme("sqrt3").value());
  const Mesh mesh = triangle_torus(20, 20);
  for (const BakeRequest& request : {BakeRequest{.level = 3}, {.rows = TableRows::samples, .samples = {{}}}}) {
    const BakeStatistics planned = bake_plan(patterns, mesh, request).statistics,
                         made = bake(patterns, mesh, request).statistics;
    EXPECT_EQ(planned.method, BakeMethod::rows);
    EXPECT_EQ(planned.points, made.points);
    EXPECT_GT(planned.bytes, made.bytes / 2);
    EXPECT_LT(planned.bytes, 5 * made.bytes);
  }
}

TEST(BakePlan, RefusesWhatIsOverALimit) {
  Patterns patterns(find_scheme("catmull-clark").value());
  const Mesh mesh = torus(30, 30);
  const BakeRequest request{.level = 4};
  const double needed = bake_plan(patterns, mesh, request).memory;
  EXPECT_NO_THROW(bake_plan(patterns, mesh, request, {}, needed));
  for (const double limit : {1000.0, 0.5 * needed, 0.999 * needed})
    expect_error<ResourceError>([&] { bake_plan(patterns, mesh, request, {}, limit); }, {"memory", "limit"});
}

TEST(BakePlan, RefusesWhatBakingDoes) {
  Patterns patterns(find_scheme("catmull-clark").value());
  for (const BakeRequest& request : {BakeRequest{.level = 0}, {.level = 12}, {.level = 2, .derivatives = 1}})
    expect_error<InvalidParameter>([&] { bake_plan(patterns, cube(), request); }, {});
}

}  // namespace
}  // namespace sublimit::testing
