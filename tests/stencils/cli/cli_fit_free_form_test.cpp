// SPDX-License-Identifier: Apache-2.0
// `sublimit fit` of free-form surfaces: samples of moved control points lead back to these, knots and weights stay.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <random>

#include "meshes/free_form_shapes.h"
#include "stencils/cli_program.h"
#include "sublimit/io/free_form.h"

namespace sublimit::testing {
namespace {

/// A file, another one with moved points, and samples of that as targets.
struct MovedFile {
  TemporaryDirectory directory;
  FreeForm given, moved;

  explicit MovedFile(const FreeForm& shapes) : given(shapes), moved(shapes) {
    std::mt19937_64 random(3);
    std::normal_distribution<double> step;
    for (double& x : moved.vertices.reshaped()) x += 0.1 * step(random);
    write_free_form(path("given.obj"), given);
    write_free_form(path("moved.obj"), moved);
  }
  std::string path(std::string_view name) const { return (directory / name).string(); }

  /// Columns `from,u,v,x,y,z` of what `sample` says of the moved ones.
  void write_targets(const std::vector<std::string>& places, const char* header) const {
    std::vector<std::string> arguments{"sample", path("moved.obj"), "-o", path("samples.csv"), "--quiet"};
    arguments.insert(arguments.end(), places.begin(), places.end());
    expect_done(sublimit(arguments));
    std::string text = std::string(header) + "\n";
    std::istringstream lines(read_file(path("samples.csv")));
    std::string line;
    std::getline(lines, line);
    while (std::getline(lines, line)) {
      std::vector<std::string> fields;
      std::istringstream row(line);
      for (std::string field; std::getline(row, field, ',');) fields.push_back(field);
      // Place, status, point.
      text +=
          fields[0] + "," + fields[1] + "," + fields[2] + "," + fields[4] + "," + fields[5] + "," + fields[6] + "\n";
    }
    directory.write("in.csv", text);
  }
  Outcome fit(std::vector<std::string> more = {}) const {
    std::vector<std::string> arguments{"fit", path("given.obj"), "--targets", path("in.csv"), "-o", path("out.obj")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return sublimit(arguments);
  }
};

TEST(CliFitFreeForm, FindsThePointsThatSamplesAreOf) {
  for (const FreeForm& shapes : {free_form_of({unit_sphere(), torus()}), teapot()}) {
    const MovedFile file(shapes);
    file.write_targets({"--grid", "5"}, "face,u,v,x,y,z");
    const Outcome outcome = file.fit({"--report", file.path("fit.json")});
    expect_done(outcome);
    EXPECT_NE(outcome.out.find("the limit is near"), std::string::npos) << outcome.out;
    const FreeForm out = read_free_form(file.path("out.obj"));
    constexpr double found_points = 1e-11;  // by least squares, with the condition of the places
    EXPECT_LE((out.vertices - file.moved.vertices).cwiseAbs().maxCoeff(), found_points);
    EXPECT_EQ(out.weights, file.given.weights);
    ASSERT_EQ(out.surfaces.size(), file.given.surfaces.size());
    for (size_t i = 0; i < out.surfaces.size(); ++i) {
      EXPECT_EQ(out.surfaces[i].points, file.given.surfaces[i].points);
      EXPECT_EQ(out.surfaces[i].u.parameters, file.given.surfaces[i].u.parameters);
    }
    const auto report = nlohmann::json::parse(read_file(file.path("fit.json")));
    EXPECT_EQ(report["scheme"], "free-form");
    EXPECT_EQ(report["conditioning"]["rank"], out.vertices.rows());
    constexpr double near_targets = 1e-12;
    EXPECT_LE(report["position_error"]["largest"], near_targets);
  }
}

TEST(CliFitFreeForm, TakesPlacesOfPatchesPinsAndFairness) {
  const MovedFile file(free_form_of({unit_sphere()}));
  std::string places = "patch,u,v\n";
  for (int i = 0; i <= 8; ++i)
    for (int j = 0; j <= 8; ++j)
      places += "0," + std::to_string(i / 8.0 * 4) + "," + std::to_string(j / 8.0 * 2) + "\n";
  const FreeFormDirection& u = file.given.surfaces[0].u;
  ASSERT_EQ(u.first, 0);
  ASSERT_EQ(u.last, 4);
  ASSERT_EQ(file.given.surfaces[0].v.last, 2);
  file.directory.write("places.csv", places);
  file.write_targets({"--at", file.path("places.csv")}, "patch,u,v,x,y,z");
  expect_done(file.fit({"--pin", "0,7", "--thin-plate", "1e-9", "--quiet"}));
  const FreeForm out = read_free_form(file.path("out.obj"));
  EXPECT_EQ(out.vertices.row(0), file.given.vertices.row(0));
  EXPECT_EQ(out.vertices.row(7), file.given.vertices.row(7));
  // The thin plate and the pins pull a little.
  const double off = (out.vertices - file.moved.vertices).rowwise().norm().mean();
  EXPECT_LT(off, 0.3);
  EXPECT_GT(off, 1e-9);
}

TEST(CliFitFreeForm, RefusesWithTheRightWay) {
  const MovedFile file(free_form_of({unit_sphere()}));
  const auto refused = [&](const char* csv, std::vector<std::string> more, int status,
                           std::initializer_list<std::string_view> parts) {
    file.directory.write("in.csv", csv);
    expect_failure(file.fit(std::move(more)), status, parts);
    EXPECT_FALSE(std::filesystem::exists(file.path("out.obj")));
  };
  refused("vertex,x,y,z\n0,1,2,3\n", {}, 3, {"in.csv", "targets at vertices", "patch,u,v,x,y,z"});
  refused("patch,u,v,x,y,z\n1,0,0,1,2,3\n", {}, 3, {"in.csv:2", "patch 1 does not exist", "0 to 0"});
  refused("patch,u,v,x,y,z\n0,0,9,1,2,3\n", {}, 3, {"in.csv:2", "9"});
  refused("face,u,v,x,y,z\n8,0,0,1,2,3\n", {}, 3, {"in.csv:2", "8"});
  refused("face,u,v,x,y,z\n0,0,2,1,2,3\n", {}, 3, {"in.csv:2"});
  const char* const good = "face,u,v,x,y,z\n0,0,0,1,2,3\n";
  refused(good, {"--picture", file.path("p.svg")}, 2, {"--picture is for meshes"});
  refused(good, {"--refine", "1"}, 2, {"--refine is not for free-form surfaces"});
  refused(good, {"--boundary", "none"}, 2, {"--boundary is for meshes"});
  refused(good, {"--pin", "99"}, 2, {"99"});
  expect_failure(sublimit({"fit", file.path("given.obj"), "--cloud", file.path("in.csv"), "-o", file.path("out.obj")}),
                 3, {"in.csv", "x,y,z[,weight]"});
  file.directory.write("r.json", R"({"kind": "bezier_surface", "degree": [1, 1], "points":
      [[0,0,0],[1,0,0],[0,1,0],[1,1,0]]})");
  expect_failure(sublimit({"fit", file.path("r.json"), "--targets", file.path("in.csv"), "-o", file.path("out.obj")}),
                 2, {"sublimit construct"});
  // Meshes do not take patches.
  file.directory.write("cage.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n");
  file.directory.write("in.csv", "patch,u,v,x,y,z\n0,0,0,1,2,3\n");
  expect_failure(sublimit({"fit", file.path("cage.obj"), "-s", "catmull-clark", "--targets", file.path("in.csv"), "-o",
                           file.path("out.obj")}),
                 3, {"in.csv", "face,u,v,x,y,z"});
}

}  // namespace
}  // namespace sublimit::testing
