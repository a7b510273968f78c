// SPDX-License-Identifier: Apache-2.0
// `sublimit step` of free-form surfaces and recipes.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <numbers>

#include "meshes/free_form_shapes.h"
#include "stencils/cli_program.h"
#include "stencils/recipes/recipe_samples.h"
#include "support/tolerance.h"

namespace sublimit::testing {
namespace {

struct Exported {
  std::string text;
  nlohmann::json report;
};

/// A valid file of a job, and its report.
Exported exported(const TemporaryDirectory& directory, const std::string& file) {
  const std::string out = (directory / "o.step").string(), report = (directory / "report.json").string();
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
  const double pi = std::numbers::pi, volume = 4 * pi / 3 + 6 * pi * pi;
  EXPECT_NEAR(made.report["volume"], volume, rounding(1000, volume));  // some hundred nodes on some ten faces
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

TEST(CliStepPatches, TrianglesWithNormalsAreFacesByPiper) {
  const TemporaryDirectory directory;
  std::string text;
  for (const char* const keyword : {"v", "vn"})
    for (const char* const axis : {"1 0 0", "-1 0 0", "0 1 0", "0 -1 0", "0 0 1", "0 0 -1"})
      text += std::string(keyword) + " " + axis + "\n";
  for (const char* const face : {"1//1 3//3 5//5", "3//3 2//2 5//5", "2//2 4//4 5//5", "4//4 1//1 5//5",
                                 "3//3 1//1 6//6", "2//2 3//3 6//6", "4//4 2//2 6//6", "1//1 4//4 6//6"})
    text += std::string("f ") + face + "\n";
  const std::string mesh = directory.write("octahedron.obj", text);
  const std::string out = (directory / "o.step").string(), report = (directory / "r.json").string();
  expect_done(sublimit({"step", mesh, "-s", "piper", "-o", out, "--report", report}));
  const nlohmann::json json = nlohmann::json::parse(read_file(report));
  EXPECT_EQ(json["valid"], true);
  EXPECT_EQ(json["solids"], 1);
  EXPECT_EQ(json["faces"], 8 * 9);
  EXPECT_EQ(json["shared_edges"], 8 * 9 * 2);
  EXPECT_LT(json["gap"], cad_exact);
  EXPECT_LT(json["angle"], cad_exact);
  const Outcome refused = sublimit({"step", mesh, "-s", "nielson", "-o", (directory / "n.step").string()});
  EXPECT_EQ(refused.status, 3);
  EXPECT_NE(refused.err.find("nielson is no B-spline"), std::string::npos) << refused.err;
  EXPECT_FALSE(std::filesystem::exists(directory / "n.step"));
}

TEST(CliStepPatches, EveryRecipeOfASurfaceIsExportedOrRefused) {
  const TemporaryDirectory directory;
  const std::string out = (directory / "o.brep").string();
  int surfaces = 0;
  for (const auto& [kind, fields] : sample_fields()) {
    const std::string file = directory.write("r.json", R"({"kind": ")" + kind + "\", " + fields + "}");
    const Outcome run = sublimit({"step", file, "-o", out, "--quiet"});
    const bool refused = kind == "screw" || kind == "gregory" || kind == "nielson";
    if (run.status == 0) ++surfaces, std::filesystem::remove(out);
    if (!refused) continue;
    EXPECT_EQ(run.status, 3) << kind;
    EXPECT_NE(run.err.find("recipe 0 (" + kind + ")"), std::string::npos) << run.err;
    EXPECT_NE(run.err.find("is no B-spline"), std::string::npos) << run.err;
    EXPECT_FALSE(std::filesystem::exists(out)) << kind;
  }
  EXPECT_EQ(surfaces, 18);
}

TEST(CliStepPatches, WhatOpenCascadeRefusesIsAnErrorOfTheInput) {
  const TemporaryDirectory directory;
  const std::string knots =
      directory
          .write("knots.json", R"({"kind": "revolution", "profile": {"degree": 2, "knots": )"
                               R"([0, 0, 0, 1e-308, 1e-308, 1e-308], "points": [[0, -1], [2, 0], [0, 1]]}})")
          .string();
  const std::string out = (directory / "o.step").string();
  expect_failure(sublimit({"step", knots, "-o", out}), 3, {"OpenCASCADE does not take the surface", "too close"});
  EXPECT_FALSE(std::filesystem::exists(out));
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
