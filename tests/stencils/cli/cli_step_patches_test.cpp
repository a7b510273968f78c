// SPDX-License-Identifier: Apache-2.0
// `sublimit step` of free-form surfaces and recipes.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <numbers>

#include "stencils/cli_program.h"
#include "stencils/recipes/recipe_samples.h"
#include "support/free_form_shapes.h"
#include "support/tolerance.h"

namespace sublimit::testing {
namespace {

struct Exported {
  std::string text;
  nlohmann::json report;
};

/// A valid file of a job, and its report.
Exported exported(const TemporaryDirectory& directory, const std::string& file) {
  const std::string out = (directory / "o.step").string(), report = (directory / "r.json").string();
  expect_done(sublimit({"step", file, "-o", out, "--report", report}));
  Exported result{read_file(out), nlohmann::json::parse(read_file(report))};
  EXPECT_TRUE(result.text.starts_with("ISO-10303-21;"));
  EXPECT_EQ(result.report["valid"], true);
  return result;
}

TEST(CliStepPatches, ClosedNurbsAreSolids) {
  const TemporaryDirectory directory;
  write_free_form(directory / "s.obj", free_form_of({unit_sphere(), torus()}));
  const Exported made = exported(directory, (directory / "s.obj").string());
  EXPECT_EQ(made.report["solids"], 2);
  EXPECT_EQ(made.report["shells"], 0);
  EXPECT_EQ(made.report["faces"], 2);
  EXPECT_EQ(made.report["seam_edges"], 3);
  EXPECT_EQ(made.report["point_sides"], 2);
  const double pi = std::numbers::pi;
  EXPECT_NEAR(made.report["volume"], 4 * pi / 3 + 6 * pi * pi, 1e-9);
  EXPECT_NE(made.text.find("RATIONAL_B_SPLINE_SURFACE"), std::string::npos);
}

TEST(CliStepPatches, NamesOfGroupsAndRecipesAreThoseOfFaces) {
  const TemporaryDirectory directory;
  FreeForm shapes = teapot();
  shapes.names = {"rim", "pot"};
  for (size_t s = 0; s < shapes.surfaces.size(); ++s) {
    shapes.surfaces[s].object = 1;
    if (s < 4) shapes.surfaces[s].group = 0;
  }
  write_free_form(directory / "t.obj", shapes);
  const Exported teapot = exported(directory, (directory / "t.obj").string());
  EXPECT_EQ(teapot.report["faces"], 32);
  EXPECT_EQ(teapot.report["shells"], 4);
  EXPECT_EQ(teapot.report["volume"], nullptr);
  EXPECT_NE(teapot.text.find("'rim'"), std::string::npos);
  EXPECT_NE(teapot.text.find("'pot'"), std::string::npos);
  const std::string recipe = directory.write(
      "r.json",
      R"({"kind": "bezier_triangle", "name": "sail", "degree": 1, "points": [[0, 0, 0], [1, 0, 0], [0, 1, 0]]})");
  const Exported sail = exported(directory, recipe);
  EXPECT_EQ(sail.report["faces"], 3);
  EXPECT_EQ(sail.report["shared_edges"], 3);
  EXPECT_NEAR(sail.report["area"], 0.5, cad_exact);
  EXPECT_NE(sail.text.find("'sail'"), std::string::npos);
}

TEST(CliStepPatches, EveryRecipeOfASurfaceIsExportedOrRefused) {
  const TemporaryDirectory directory;
  const std::string out = (directory / "o.brep").string();
  int surfaces = 0;
  for (const auto& [kind, fields] : sample_fields()) {
    const std::string file = directory.write("r.json", R"({"kind": ")" + kind + "\", " + fields + "}");
    const Outcome run = sublimit({"step", file, "-o", out, "--quiet"});
    const bool refused = kind == "screw" || kind == "gregory";
    if (run.status == 0) ++surfaces;
    if (!refused) continue;
    EXPECT_EQ(run.status, 3) << kind;
    EXPECT_NE(run.err.find("recipe 0 (" + kind + ") is no B-spline"), std::string::npos) << run.err;
  }
  EXPECT_EQ(surfaces, 18);
}

TEST(CliStepPatches, LeavesNoFileAfterErrors) {
  const TemporaryDirectory directory;
  write_free_form(directory / "s.obj", free_form_of({unit_sphere()}));
  const std::string file = (directory / "s.obj").string(), out = (directory / "o.step").string();
  for (const std::vector<std::string>& options : std::vector<std::vector<std::string>>{
           {"--join", "g1"}, {"--no-packing"}, {"--tolerance", "-1"}, {"--boundary", "none"}}) {
    std::vector<std::string> arguments{"step", file, "-o", out};
    arguments.insert(arguments.end(), options.begin(), options.end());
    EXPECT_EQ(sublimit(arguments).status, 2) << options[0];
  }
  EXPECT_FALSE(std::filesystem::exists(out));
}

}  // namespace
}  // namespace sublimit::testing
