// SPDX-License-Identifier: Apache-2.0
// `sublimit closest` and `sublimit intersect` of free-form surfaces and recipes.
#include <gtest/gtest.h>

#include <cmath>

#include "meshes/free_form_shapes.h"
#include "stencils/cli_program.h"
#include "stencils/csv_fields.h"
#include "stencils/recipes/recipe_samples.h"
#include "support/tolerance.h"

namespace sublimit::testing {
namespace {

std::string write_shapes(const TemporaryDirectory& directory) {
  write_free_form(directory / "s.obj", free_form_of({unit_sphere(), torus()}));
  return (directory / "s.obj").string();
}

TEST(CliClosest, FindsTheFeetOnNurbs) {
  const TemporaryDirectory directory;
  const std::string shapes = write_shapes(directory), out = (directory / "o.csv").string(),
                    points = directory.write("q.csv", "x,y,z\n0.25,0,0.5\n0,3,3\n1.5,0.25,0\n").string();
  expect_done(sublimit({"closest", shapes, "--points", points, "--signed", "-o", out}));
  const std::vector<CsvRow> rows = csv_rows(out);
  ASSERT_EQ(rows.size(), 4u);
  const auto distance = [](double x, double y, double z) {
    const double ring = std::hypot(std::hypot(x, y) - 3, z) - 1, ball = std::hypot(x, y, z) - 1;
    return std::min(ring, ball);
  };
  const std::vector<double> expected{distance(0.25, 0, 0.5), distance(0, 3, 3), distance(1.5, 0.25, 0)};
  for (size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(csv_number(rows[i + 1][9]), expected[i], 10 * found_distance);
    EXPECT_NEAR(csv_number(rows[i + 1][10]), std::abs(expected[i]), 10 * found_distance);
  }
}

TEST(CliIntersect, FindsHitsOnNurbs) {
  const TemporaryDirectory directory;
  const std::string shapes = write_shapes(directory), out = (directory / "o.csv").string(),
                    rays = directory.write("r.csv", "ox,oy,oz,dx,dy,dz\n-8,0.25,0,1,0,0\n0.5,0.25,9,0,0,-1\n").string();
  expect_done(sublimit({"intersect", shapes, "--rays", rays, "--all", "-o", out}));
  const std::vector<CsvRow> rows = csv_rows(out);
  const auto across = [](double radius) { return std::sqrt(radius * radius - 0.0625); };
  const std::vector<double> expected{8 - across(4), 8 - across(2), 8 - across(1),         8 + across(1),
                                     8 + across(2), 8 + across(4), 9 - std::sqrt(0.6875), 9 + std::sqrt(0.6875)};
  ASSERT_EQ(rows.size(), expected.size() + 1);
  for (size_t i = 0; i < expected.size(); ++i) EXPECT_NEAR(csv_number(rows[i + 1][1]), expected[i], 10 * found_hit);
}

// Along the axis, 1e-5 beside it, from the centre, and elsewhere: t by the sphere's equation. The torus is not met.
TEST(CliIntersect, FindsPolesOfASphere) {
  const TemporaryDirectory directory;
  const std::string shapes = write_shapes(directory), out = (directory / "o.csv").string(),
                    rays = directory
                               .write("r.csv",
                                      "ox,oy,oz,dx,dy,dz\n0,0,-5,0,0,1\n0.00001,0,-5,0,0,1\n0,0,0,0,0,1\n"
                                      "0.3,0,-5,0,0,1\n")
                               .string();
  expect_done(sublimit({"intersect", shapes, "--rays", rays, "--all", "-o", out}));
  const std::vector<CsvRow> rows = csv_rows(out);
  const double off = std::sqrt(0.91);
  const std::vector<std::pair<double, double>> expected{{0, 4}, {0, 6},       {1, 4},      {1, 6},
                                                        {2, 1}, {3, 5 - off}, {3, 5 + off}};
  ASSERT_EQ(rows.size(), expected.size() + 1);
  for (size_t i = 0; i < expected.size(); ++i) {
    EXPECT_EQ(csv_number(rows[i + 1][0]), expected[i].first);
    EXPECT_NEAR(csv_number(rows[i + 1][1]), expected[i].second, found_hit);
    EXPECT_NE(rows[i + 1][11], "touching");
  }
}

// A pyramid over [-1, 1]^2 as a cone: at x the distance from the apex (0, 0, 2) is 2 max(|x|, |y|) down.
TEST(CliIntersect, FindsTheApexOfACone) {
  const TemporaryDirectory directory;
  const std::string cone = directory
                               .write("cone.json",
                                      R"({"kind": "cone", "apex": [0, 0, 2], "curve": {"degree": 1,
                                          "knots": [0, 0, 1, 2, 3, 4, 4],
                                          "points": [[-1, -1], [1, -1], [1, 1], [-1, 1], [-1, -1]]}})")
                               .string(),
                    out = (directory / "o.csv").string(),
                    rays = directory
                               .write("r.csv",
                                      "ox,oy,oz,dx,dy,dz\n0,0,5,0,0,-1\n0.001,0,5,0,0,-1\n0.2,0.1,5,0,0,-1\n"
                                      "1e-12,0,5,0,0,-1\n1e-7,1e-8,5,0,0,-1\n")
                               .string();
  expect_done(sublimit({"intersect", cone, "--rays", rays, "--all", "-o", out}));
  const std::vector<CsvRow> rows = csv_rows(out);
  const std::vector<double> expected{3, 3.002, 3.4, 3, 3 + 2e-7};
  ASSERT_EQ(rows.size(), expected.size() + 1);
  for (size_t i = 0; i < expected.size(); ++i) {
    EXPECT_EQ(csv_number(rows[i + 1][0]), double(i));
    EXPECT_NEAR(csv_number(rows[i + 1][1]), expected[i], found_hit);
  }
}

TEST(CliClosest, RefusesOfPatchesWhatIsOfMeshes) {
  const TemporaryDirectory directory;
  const std::string shapes = write_shapes(directory), out = (directory / "o.csv").string(),
                    points = directory.write("q.csv", "x,y,z\n0,0,0\n").string(),
                    rays = directory.write("r.csv", "ox,oy,oz,dx,dy,dz\n0,0,0,1,0,0\n").string();
  const auto refused = [&](const std::vector<std::string>& arguments, int status,
                           std::initializer_list<std::string_view> parts) {
    expect_failure(sublimit(arguments), status, parts);
    EXPECT_FALSE(std::filesystem::exists(out));
  };
  refused({"closest", shapes, "--points", points, "-o", out, "--triangulate"}, 2, {"--triangulate is for meshes"});
  const std::string mesh = directory.write("m.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").string();
  refused({"closest", mesh, "--points", points, "-o", out}, 2, {"-s SCHEME is missing"});
  refused({"intersect", mesh, "--rays", rays, "-o", out}, 2, {"-s SCHEME is missing"});
  write_free_form(directory / "pot.obj", teapot());
  const std::string pot = (directory / "pot.obj").string();
  refused({"closest", pot, "--points", points, "--signed", "-o", out}, 3, {"pot.obj", "closed surfaces alone"});
}

TEST(CliClosest, EveryRecipeOfASurfaceIsProvedOrSaidNotToBe) {
  const TemporaryDirectory directory;
  const std::string out = (directory / "o.csv").string(),
                    points = directory.write("q.csv", "x,y,z\n0.3,0.2,1.5\n").string(),
                    rays = directory.write("r.csv", "ox,oy,oz,dx,dy,dz\n0.3,0.2,5,0.01,0.02,-1\n").string();
  int proved = 0;
  for (const auto& [kind, fields] : sample_fields()) {
    const std::string file = directory.write("r.json", R"({"kind": ")" + kind + "\", " + fields + "}").string();
    if (sublimit({"closest", file, "--points", points, "-o", out, "--quiet"}).status != 0) {
      EXPECT_FALSE(std::filesystem::exists(out)) << kind;
      continue;
    }
    const std::vector<CsvRow> rows = csv_rows(out);
    ASSERT_EQ(rows.size(), 2u) << kind;
    const double distance = csv_number(rows[1][9]), lower = csv_number(rows[1][10]);
    std::filesystem::remove(out);
    const Outcome traced = sublimit({"intersect", file, "--rays", rays, "-o", out, "--quiet"});
    if (kind == "screw" || kind == "gregory") {
      EXPECT_EQ(lower, 0) << kind;
      EXPECT_EQ(traced.status, 3) << kind;
      expect_parts(traced.err, {"r.json", "face 0, of patch 0, is no polynomial"});
      EXPECT_FALSE(std::filesystem::exists(out)) << kind;
      continue;
    }
    EXPECT_NEAR(lower, distance, 10 * found_distance) << kind;
    EXPECT_EQ(traced.status, 0) << kind << traced.err;
    std::filesystem::remove(out);
    ++proved;
  }
  EXPECT_EQ(proved, 18);
}

}  // namespace
}  // namespace sublimit::testing
