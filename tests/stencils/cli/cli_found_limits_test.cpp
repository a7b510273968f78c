// SPDX-License-Identifier: Apache-2.0
// Meshes that the program once called a fault of its own, or that one command took and another refused: limits at
// vertices, of tables and at places are one answer. The meshes that random changes found, where a checkout has them
// beside it, and small ones that show the same.
#include <algorithm>
#include <cmath>
#include <sstream>

#include "stencils/cli_tables.h"
#include "sublimit/scheme/detail/prepare.h"
#include "support/tolerance.h"

namespace sublimit::testing {
namespace {

struct Found {
  std::string name;
  std::string scheme;
  std::vector<std::string> arguments;
  bool triangles = false;  ///< --triangulate is among them
};

std::vector<Found> found() {
  return {{"w1-0000-70-limit", "kobbelt", {"--boundary", "none"}},
          {"w1-0002-bakeok-limitfails-limit", "kobbelt", {"--boundary", "none"}},
          {"w1-0012-70-fit", "averaging", {"--no-creases", "--boundary", "edge-only"}},
          {"w1-0016-bakeok-limitfails-limit", "modified-butterfly", {"--triangulate", "--no-creases"}, true},
          {"w1-0023-70-sample", "averaging", {"--option", "degree=2"}},
          {"w1-0033-70-bake", "mid-edge", {}}};
}

/// Points in general position.
Mesh sheets(Index num_vertices, const std::vector<std::vector<Index>>& faces) {
  std::vector<Eigen::Vector3d> points;
  for (Index i = 0; i < num_vertices; ++i)
    points.push_back({std::cos(2.0 * i), std::sin(3.0 * i), std::cos(1.0 + 5.0 * i)});
  return make_mesh(points, faces);
}

struct Small {
  std::string name;
  Mesh mesh;
  std::vector<Found> commands;
};

std::vector<Small> small() {
  return {{"an edge that ends inside the sheet of two faces back to back",
           sheets(6, {{0, 1, 2, 3}, {3, 2, 1, 0}, {0, 1, 4}, {1, 0, 5}}),
           {{"", "kobbelt", {"--boundary", "none"}},
            {"", "kobbelt", {}},
            {"", "averaging", {"--boundary", "edge-only"}},
            {"", "butterfly", {"--triangulate"}, true},
            {"", "modified-butterfly", {"--triangulate"}, true}}},
          {"faces back to back",
           sheets(7, {{0, 1, 2}, {2, 1, 0}, {3, 4, 5, 6}, {6, 5, 4, 3}}),
           {{"", "mid-edge", {}}, {"", "mid-edge-habib-warren", {}}, {"", "averaging", {"--option", "degree=2"}}}},
          {"a vertex of two faces",
           sheets(5, {{1, 0, 2, 3}, {2, 0, 1, 4}, {2, 4, 3}, {1, 3, 4}}),
           {{"", "averaging", {"--option", "degree=2"}}, {"", "averaging", {"--option", "degree=4"}}}}};
}

/// Of an .obj, which may have no faces left: those of holes are not written.
Points vertices_of(const std::string& path) {
  std::istringstream lines(read_file(path));
  std::vector<Eigen::RowVector3d> all;
  for (std::string line; std::getline(lines, line);)
    if (line.starts_with("v ")) {
      std::istringstream numbers(line.substr(2));
      Eigen::RowVector3d& v = all.emplace_back();
      numbers >> v.x() >> v.y() >> v.z();
    }
  Points points(std::ssize(all), 3);
  for (Index i = 0; i < points.rows(); ++i) points.row(i) = all[size_t(i)];
  return points;
}

/// `limit` and `bake --limit` of these levels are the same points in the order of the level or another.
void expect_one_answer(const std::string& mesh, const Found& command, int level, const TemporaryDirectory& directory) {
  SCOPED_TRACE(mesh + " under " + command.scheme + ", level " + std::to_string(level));
  const auto run = [&](const char* verb, const std::vector<std::string>& more) {
    std::vector<std::string> all{verb, mesh, "-s", command.scheme, "--quiet"};
    all.insert(all.end(), command.arguments.begin(), command.arguments.end());
    all.insert(all.end(), more.begin(), more.end());
    return sublimit(all);
  };
  const auto path = [&](const char* name) { return (directory / name).string(); };
  const std::string l = std::to_string(level);
  expect_done(run("limit", {"-l", l, "-o", path("limit.obj")}));
  expect_done(run("bake", {"-l", l, "--limit", "--precision", "double", "-o", path("limit.safetensors")}));
  std::vector<std::string> apply{"apply", path("limit.safetensors"), mesh, "-o", path("baked.obj"), "--quiet"};
  if (command.triangles) apply.push_back("--any-cage");
  expect_done(sublimit(apply));
  if (::testing::Test::HasFailure()) return;
  const Points one = vertices_of(path("limit.obj")), other = vertices_of(path("baked.obj"));
  ASSERT_EQ(one.rows(), other.rows());
  ASSERT_GT(one.rows(), 0);
  const double size = diagonal(one);
  for (const auto& [from, to] : {std::pair(&one, &other), std::pair(&other, &one)})
    for (Index i = 0; i < from->rows(); ++i)
      EXPECT_LE((to->rowwise() - from->row(i)).rowwise().norm().minCoeff(), other_route * size) << "point " << i;
}

/// Places at the corners of faces have a row each, and are some vertex's limit.
void expect_places(const std::string& mesh, const Found& command, const TemporaryDirectory& directory) {
  SCOPED_TRACE(mesh + " under " + command.scheme);
  std::vector<std::string> all{"sample",
                               mesh,
                               "-s",
                               command.scheme,
                               "--quiet",
                               "--grid",
                               "2",
                               "--derivatives",
                               "1",
                               "-o",
                               (directory / "places.csv").string()};
  all.insert(all.end(), command.arguments.begin(), command.arguments.end());
  expect_done(sublimit(all));
}

TEST(CliFoundLimits, OfSmallMeshes) {
  const TemporaryDirectory directory;
  for (const Small& one : small()) {
    SCOPED_TRACE(one.name);
    const std::string mesh = (directory / "mesh.obj").string();
    write_obj(mesh, one.mesh);
    for (const Found& command : one.commands) {
      for (const int level : {0, 2}) expect_one_answer(mesh, command, level, directory);
      expect_places(mesh, command, directory);
    }
  }
}

TEST(CliFoundLimits, OfMeshesFoundByRandomChanges) {
  const std::filesystem::path folder = std::filesystem::path(SUBLIMIT_SHARED_MESHES) / ".." / "found";
  if (!std::filesystem::is_directory(folder))
    GTEST_SKIP() << "NO SHARED MESHES at " << folder << ": " << found().size() << " meshes have no limits";
  const TemporaryDirectory directory;
  for (const Found& command : found()) {
    const std::string mesh = (folder / (command.name + ".obj")).string();
    for (const int level : {0, 1}) expect_one_answer(mesh, command, level, directory);
    expect_places(mesh, command, directory);
  }
}

TEST(CliFoundLimits, FitsToVerticesOfFoundMeshes) {
  // Targets at two vertices, of which one has an edge that ends inside its sheet.
  const TemporaryDirectory directory;
  const std::string mesh = (directory / "mesh.obj").string();
  write_obj(mesh, small()[0].mesh);
  directory.write("targets.csv", "vertex,x,y,z\n0,1,0.5,0.25\n2,0,1,-0.5\n");
  expect_done(sublimit({"fit", mesh, "--targets", (directory / "targets.csv").string(), "-s", "averaging", "--boundary",
                        "edge-only", "--method", "iterative", "-o", (directory / "fitted.obj").string(), "--quiet"}));
  expect_done(sublimit({"limit", (directory / "fitted.obj").string(), "-s", "averaging", "--boundary", "edge-only",
                        "--quiet", "-o", (directory / "limit.obj").string()}));
  const Points limit = vertices_of((directory / "limit.obj").string());
  EXPECT_LE((limit.row(0) - Eigen::RowVector3d(1, 0.5, 0.25)).norm(), found_control_points);
  EXPECT_LE((limit.row(2) - Eigen::RowVector3d(0, 1, -0.5)).norm(), found_control_points);
}

TEST(CliFoundLimits, FitsToTheTargetsFoundByRandomChanges) {
  const std::filesystem::path folder = std::filesystem::path(SUBLIMIT_SHARED_MESHES) / ".." / "found";
  if (!std::filesystem::is_directory(folder)) GTEST_SKIP() << "NO SHARED MESHES at " << folder << ": a fit is not made";
  const TemporaryDirectory directory;
  const std::string name = "w1-0012-70-fit";
  const Outcome outcome = sublimit(
      {"fit", (folder / (name + ".obj")).string(), "--targets", (folder / (name + ".csv")).string(), "-s", "averaging",
       "--no-creases", "--boundary", "edge-only", "--method", "iterative", "-o", (directory / "fitted.obj").string()});
  // Whether the targets can be met is another question; the limits at their vertices exist.
  EXPECT_EQ(outcome.err.find("fault of ours"), std::string::npos) << outcome.err;
  EXPECT_EQ(outcome.err.find("no limit"), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.status, 70);
  EXPECT_NE(outcome.status, -1);
}

}  // namespace
}  // namespace sublimit::testing
