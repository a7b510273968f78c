// SPDX-License-Identifier: Apache-2.0
// `sublimit construct`, and `sublimit sample` of recipes.
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "stencils/cli_program.h"
#include "stencils/recipes/recipe_samples.h"
#include "sublimit/io/free_form.h"

namespace sublimit::testing {
namespace {

std::string file_of(const TemporaryDirectory& directory, const std::string& text) {
  return directory.write("r.json", text).string();
}

std::string both() {
  return R"({"recipes": [)" + sample_recipe("revolution", R"("name": "cylinder", )") + ", " +
         sample_recipe("nurbs_curve", R"("name": "arc", )") + ", " + sample_recipe("nielson") + "]}";
}

TEST(CliConstruct, WritesNets) {
  const TemporaryDirectory directory;
  const std::string in = file_of(directory, R"({"recipes": [)" + sample_recipe("revolution") + ", " +
                                                sample_recipe("bezier_curve") + "]}"),
                    out = (directory / "n.obj").string();
  const Outcome outcome = expect_done(sublimit({"construct", in, "-o", out}));
  expect_parts(outcome.out, {"n.obj: 1 surface, 1 curve, 21 control points"});
  const FreeForm nets = read_free_form(out);
  EXPECT_EQ(nets.surfaces.size(), 1u);
  EXPECT_EQ(nets.curves.size(), 1u);
  expect_parts(read_file(out), {"cstype rat bspline", "cstype bezier"});
  // The program samples what it wrote.
  expect_done(sublimit({"sample", out, "--grid", "3", "-o", (directory / "s.csv").string(), "--quiet"}));
  EXPECT_EQ(expect_done(sublimit({"construct", in, "-o", out, "--quiet"})).out, "");
}

TEST(CliConstruct, SaysWhichKindHasNoNet) {
  for (const char* kind : {"bezier_triangle", "screw", "gregory", "nielson", "implicit", "curve_join"}) {
    const TemporaryDirectory directory;
    const std::string in = file_of(directory, sample_recipe(kind, R"("name": "a", )"));
    expect_failure(sublimit({"construct", in, "-o", (directory / "n.obj").string()}), 3,
                   {"recipe 0 'a' (" + std::string(kind) + "): there is no exact net to write"});
    EXPECT_EQ(directory.num_files(), 1);
  }
}

TEST(CliConstruct, RefusesBadInput) {
  const TemporaryDirectory directory;
  const std::string out = (directory / "n.obj").string();
  expect_failure(sublimit({"construct", file_of(directory, R"({"kind": "coone"})"), "-o", out}), 3,
                 {"r.json: recipe 0: unknown kind \"coone\"; the nearest are cone"});
  expect_failure(sublimit({"construct", (directory / "none.json").string(), "-o", out}), 3, {"none.json"});
  expect_failure(
      sublimit({"construct", file_of(directory, sample_recipe("cone")), "-o", (directory / "n.ply").string()}), 2,
      {".obj"});
  // What constructions refuse is a fault of the file, not of the command line.
  const std::string sweep = sample_recipe("revolution", R"("arcs": 1, )");
  expect_failure(sublimit({"construct", file_of(directory, sweep), "-o", out}), 3,
                 {"each must be less than 180 degrees"});
}

TEST(CliConstruct, WarnsOfWhatItAccepts) {
  const TemporaryDirectory directory;
  const std::string in = file_of(directory, sample_recipe("bspline_surface")), out = (directory / "n.obj").string();
  const Outcome outcome = sublimit({"construct", in, "-o", out});
  EXPECT_EQ(outcome.status, 0);
  expect_parts(outcome.err, {"sublimit: warning: ", "(bspline_surface): knots_u: the first and the last are left out"});
  EXPECT_EQ(expect_done(sublimit({"construct", in, "-o", out, "--quiet"})).out, "");
}

TEST(CliConstruct, ListsAllKinds) {
  const std::string help = expect_done(sublimit({"construct", "--help"})).out;
  expect_parts(help, {"Examples:", "sublimit construct"});
  for (const auto& [kind, fields] : sample_fields()) expect_parts(help, {kind});
}

/// Rows of a CSV but the header.
std::vector<std::vector<std::string>> sampled_rows(const std::string& text) {
  std::vector<std::vector<std::string>> rows;
  std::istringstream lines(text);
  std::string line;
  std::getline(lines, line);
  while (std::getline(lines, line)) {
    std::istringstream fields(line);
    rows.emplace_back();
    for (std::string field; std::getline(fields, field, ',');) rows.back().push_back(field);
  }
  return rows;
}

TEST(CliSampleRecipes, SurfacesByFaces) {
  const TemporaryDirectory directory;
  const std::string in = file_of(directory, sample_recipe("revolution")), out = (directory / "s.csv").string();
  const Outcome outcome = expect_done(sublimit({"sample", in, "--grid", "4", "--derivatives", "1", "-o", out}));
  expect_parts(outcome.out, {"64 samples", "4 faces of 1 surfaces"});
  const std::string text = read_file(out);
  EXPECT_TRUE(text.starts_with("face,u,v,status,x,y,z,xu,yu,zu,xv,yv,zv,nx,ny,nz\n0,0,0,")) << text.substr(0, 200);
  constexpr double last_bits = 1e-15;  // a unit circle in rational form
  for (const auto& row : sampled_rows(text))
    EXPECT_NEAR(std::hypot(std::stod(row[4]), std::stod(row[5])), 1, last_bits);
}

TEST(CliSampleRecipes, EverySampleOfASurfaceOrCurve) {
  for (const auto& [kind, fields] : sample_fields()) {
    SCOPED_TRACE(kind);
    const TemporaryDirectory directory;
    const std::string in = file_of(directory, sample_recipe(kind)), out = (directory / "s.csv").string();
    if (kind == "piper")
      directory.write("sphere.obj", "v 1 0 0\nv 0 1 0\nv 0 0 1\nvn 1 0 0\nvn 0 1 0\nvn 0 0 1\nf 1//1 2//2 3//3\n");
    const Outcome outcome = sublimit({"sample", in, "--grid", "3", "--derivatives", "2", "-o", out, "--quiet"});
    const bool is_data = kind == "implicit" || kind.ends_with("_join");
    EXPECT_EQ(outcome.status, is_data ? 3 : 0) << outcome.err;
    if (is_data) continue;
    const std::string text = read_file(out);
    EXPECT_TRUE(text.starts_with("face,u,v,status") || text.starts_with("segment,t,status"));
    EXPECT_EQ(text.find("nan"), std::string::npos);
    EXPECT_GE(sampled_rows(text).size(), 3u);
  }
}

TEST(CliSampleRecipes, TellsWhatIsLeftOutAndHowToGetIt) {
  const TemporaryDirectory directory;
  const std::string in = file_of(directory, both()), out = (directory / "s.csv").string();
  const Outcome surfaces = sublimit({"sample", in, "--grid", "2", "-o", out});
  EXPECT_EQ(surfaces.status, 0);
  expect_parts(surfaces.err, {"recipe 1 'arc' (nurbs_curve) is left out: a curve; with --curves it is sampled",
                              "recipe 2 (nielson) is left out: it is not linear"});
  expect_parts(surfaces.out, {"4 faces of 1 surfaces"});
  const Outcome curves = sublimit({"sample", in, "--curves", "--grid", "5", "-o", out});
  EXPECT_EQ(curves.status, 0);
  expect_parts(curves.err, {"recipe 0 'cylinder' (revolution) is left out: a surface; without --curves it is sampled"});
  expect_parts(curves.out, {"5 samples of 1 segments of 1 curves"});
  const std::string text = read_file(out);
  EXPECT_TRUE(text.starts_with("segment,t,status,x,y,nx,ny\n0,0,")) << text;
  constexpr double last_bits = 1e-15;  // a unit circle in rational form
  for (const auto& row : sampled_rows(text))
    EXPECT_NEAR(std::hypot(std::stod(row[3]), std::stod(row[4])), 1, last_bits);
}

TEST(CliSampleRecipes, CurvesAlongGivenPlaces) {
  const TemporaryDirectory directory;
  const std::string in = file_of(directory, sample_recipe("bmatrix_curve")), out = (directory / "s.csv").string(),
                    at = directory.write("at.csv", "segment,t\n1,0.5\n0,1\n").string();
  expect_done(sublimit({"sample", in, "--at", at, "-o", out, "--quiet"}));
  EXPECT_TRUE(read_file(out).starts_with("segment,t,status,x,y,nx,ny\n1,0.5,regular,1,0.5,")) << read_file(out);
}

TEST(CliSampleRecipes, RefusesWhatDoesNotFit) {
  const TemporaryDirectory directory;
  const std::string out = (directory / "s.csv").string(), surface = file_of(directory, sample_recipe("cone"));
  expect_failure(sublimit({"sample", surface, "--curves", "--grid", "3", "-o", out}), 3,
                 {"one recipe, none of a curve"});
  expect_failure(sublimit({"sample", surface, "--boundary", "none", "--grid", "3", "-o", out}), 2, {"--boundary"});
  const std::string triangles =
      file_of(directory, R"({"recipes": [)" + sample_recipe("bezier_triangle") + ", " + sample_recipe("cone") + "]}");
  expect_failure(sublimit({"sample", triangles, "--grid", "3", "-o", out}), 3, {"squares", "triangles"});
  expect_failure(sublimit({"sample", "p.obj", "-s", "loop", "--curves", "--grid", "3", "-o", out}), 2,
                 {"--curves is for"});
  EXPECT_EQ(directory.num_files(), 1);
}

}  // namespace
}  // namespace sublimit::testing
