// SPDX-License-Identifier: Apache-2.0
// Coordinates whose squares, areas or derivatives are larger than numbers are: a value, or an error of the input that
// says where; never "inf" or "nan" with status 0.
#include <gtest/gtest.h>

#include <regex>

#include "meshes/meshes.h"
#include "stencils/cli_program.h"
#include "sublimit/io/detail/obj.h"

namespace sublimit::testing {
namespace {

class LargeNumbers {
 public:
  std::string path(const std::string& name) const { return (directory_ / name).string(); }
  std::string file(const std::string& name, const std::string& text) const {
    return directory_.write(name, text).string();
  }
  /// A cube whose coordinates are this in size.
  std::string cube_of(double size) const {
    Mesh mesh = cube();
    mesh.positions *= size;
    write_obj(path("cube.obj"), mesh);
    return path("cube.obj");
  }

 private:
  TemporaryDirectory directory_;
};

void expect_no_odd_numbers(const std::string& text) {
  EXPECT_FALSE(std::regex_search(text, std::regex("\\b(inf|nan)\\b"))) << text;
}

TEST(CliLargeNumbers, IntegralsAreNumbersOrErrors) {
  const LargeNumbers here;
  for (const char* scheme : {"catmull-clark", "doo-sabin", "mid-edge"}) {
    const auto info = [&](double size) { return sublimit({"info", here.cube_of(size), "-s", scheme, "--limit"}); };
    expect_failure(info(1e308), 3, {"control point", "1e+308", "of the limit", "another unit of length"});
    expect_failure(info(1e200), 3, {"volume of the limit"});
    expect_failure(info(1e62), 3, {"inertia of the limit"});
    expect_no_odd_numbers(expect_done(info(1e60)).out);
    expect_no_odd_numbers(expect_done(info(1e-60)).out);
    expect_no_odd_numbers(expect_done(info(1e-300)).out);
  }
}

TEST(CliLargeNumbers, AreRefusedWhereDistancesAreTaken) {
  const LargeNumbers here;
  const std::string mesh = here.cube_of(1e200);
  expect_failure(sublimit({"analyze", mesh, "-s", "catmull-clark", "-o", here.path("out.html")}), 3,
                 {"control point 0", "1e150", "another unit of length"});
  const std::string cc = "catmull-clark";
  expect_failure(sublimit({"tessellate", mesh, "-s", cc, "--chord", "5%", "-o", here.path("out.ply")}), 3, {"unit"});
  EXPECT_FALSE(std::filesystem::exists(here.path("out.html")));
}

TEST(CliLargeNumbers, OfRecipesAreRefusedNamingWhere) {
  const LargeNumbers here;
  const std::string far =
      here.file("far.json", R"({"kind": "curve_join", "left": {"points": [[0, 0], [1, 1e155], [2, 0]], "length": 1},)"
                            R"( "right": {"points": [[2, 0], [3, 1], [4, 0]], "length": 1}})");
  const std::string weights =
      here.file("weights.json", R"({"kind": "revolution", "profile": {"degree": 1, "knots": [0, 0, 1, 1],)"
                                R"( "homogeneous_xzw": [[2, 0, 1e308], [2, 1, 1]]}})");
  const std::string short_piece = here.file(
      "short.json", R"({"kind": "curve_join", "left": {"points": [[0, 0], [1, 1e-308], [2, 0]], "length": 1},)"
                    R"( "right": {"points": [[2, 0], [3, 1], [4, 0]], "length": 1e-308}})");
  const auto analyzed = [&](const std::string& recipe) {
    return sublimit({"analyze", recipe, "-o", here.path("out.html"), "--json", here.path("out.json")});
  };
  expect_failure(analyzed(far), 3, {"far.json", "1e+155", "another unit of length"});
  expect_failure(analyzed(weights), 3, {"weights.json", "the gap inside patch 0", "is no number"});
  expect_failure(analyzed(short_piece), 3, {"short.json", "the angle between curve 0 and curve 1", "is no number"});
  EXPECT_FALSE(std::filesystem::exists(here.path("out.json")));
}

TEST(CliLargeNumbers, OfDerivativesAreRefusedNamingThePlace) {
  const LargeNumbers here;
  const std::string table = here.path("table.safetensors"), out = here.path("out.csv");
  const std::string grid = here.path("grid.obj");
  write_obj(grid, torus(4, 4));
  expect_done(sublimit({"bake", grid, "-s", "catmull-clark", "--grid", "2", "--derivatives", "2", "--precision",
                        "double", "-o", table}));
  Mesh large = torus(4, 4);
  large.positions *= 1.7e308 / large.positions.cwiseAbs().maxCoeff();
  write_obj(grid, large);
  expect_failure(sublimit({"apply", table, grid, "-o", out}), 3, {"a derivative of point", "another unit"});
  expect_failure(sublimit({"sample", grid, "-s", "catmull-clark", "--grid", "2", "--derivatives", "2", "-o", out}), 3,
                 {"place ", "another unit of length"});
  const std::string polygon = here.file("polygon.csv", "0,0\n1e308,0\n0,1e308\n-1e308,0\n0,0\n");
  expect_failure(sublimit({"sample", polygon, "-s", "lane-riesenfeld", "--grid", "3", "--derivatives", "2", "-o", out}),
                 3, {"segment ", "another unit of length"});
  EXPECT_FALSE(std::filesystem::exists(out));
}

TEST(CliLargeNumbers, ChordsAndAnglesBelowRoundingAreRefused) {
  const LargeNumbers here;
  const std::string mesh = here.cube_of(1), out = here.path("out.ply");
  for (const char* chord : {"1e-320", "1e-17"})
    expect_failure(sublimit({"tessellate", mesh, "-s", "loop", "--triangulate", "--chord", chord, "-o", out}), 2,
                   {chord, "rounded to"});
  expect_failure(sublimit({"tessellate", mesh, "-s", "catmull-clark", "--chord", "1%", "--angle", "1e-300", "-o", out}),
                 2, {"the angle", "rounded to"});
}

}  // namespace
}  // namespace sublimit::testing
