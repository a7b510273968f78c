// SPDX-License-Identifier: Apache-2.0
// The program on meshes with normals: samples and points of Nielson's and Piper's surfaces, and what it says when there
// are none.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "stencils/cli_program.h"
#include "sublimit/io/detail/obj.h"
#include "sublimit/io/detail/obj_normals.h"
#include "support/tolerance.h"

namespace sublimit::testing {
namespace {

/// An octahedron on the unit sphere; corners name normals by the numbers of the vertices.
const std::string octahedron_points = "v 1 0 0\nv -1 0 0\nv 0 1 0\nv 0 -1 0\nv 0 0 1\nv 0 0 -1\n";
const std::string octahedron_normals = "vn 1 0 0\nvn -1 0 0\nvn 0 1 0\nvn 0 -1 0\nvn 0 0 1\nvn 0 0 -1\n";
std::string octahedron_faces(bool normals) {
  std::string text;
  for (const auto& [a, b, c] :
       {std::array{1, 3, 5}, {3, 2, 5}, {2, 4, 5}, {4, 1, 5}, {3, 1, 6}, {2, 3, 6}, {4, 2, 6}, {1, 4, 6}}) {
    text += "f";
    for (const int v : {a, b, c}) {
      const std::string number = std::to_string(v);
      text += " " + number;
      if (normals) text += "//" + number;
    }
    text += "\n";
  }
  return text;
}
const std::string octahedron = octahedron_points + octahedron_normals + octahedron_faces(true);
/// How far from the sphere its patches are.
constexpr double nielson_error = 3.6e-3, piper_error = 3.3e-2;

std::vector<std::vector<std::string>> csv(const std::string& text) {
  std::vector<std::vector<std::string>> rows;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::vector<std::string>& row = rows.emplace_back();
    std::istringstream fields(line + ",");
    for (std::string field; std::getline(fields, field, ',');) row.push_back(field);
  }
  return rows;
}

TEST(CliNormalSurfaces, AreSampled) {
  const TemporaryDirectory directory;
  const std::string in = directory.write("o.obj", octahedron).string(), out = (directory / "o.csv").string();
  for (const auto& [scheme, error] : {std::pair("nielson", nielson_error), std::pair("piper", piper_error)}) {
    SCOPED_TRACE(scheme);
    const Outcome done = expect_done(
        sublimit({"sample", in, "-s", scheme, "--grid", "5", "--derivatives", "2", "--curvature", "-o", out}));
    expect_parts(done.out, {"120 samples", "crease", "8 patches"});
    const auto rows = csv(read_file(out));
    ASSERT_EQ(rows.size(), 1u + 8 * 15);
    ASSERT_EQ(rows[0].size(), 4u + 3 + 6 + 9 + 3 + 4);
    double most = 0;
    for (size_t i = 1; i < rows.size(); ++i) {
      ASSERT_EQ(rows[i].size(), rows[0].size());
      const auto number = [&](size_t field) { return std::stod(rows[i][field]); };
      most = std::max(most, std::abs(std::hypot(number(4), number(5), number(6)) - 1));
      EXPECT_GT(number(22) * number(4) + number(23) * number(5) + number(24) * number(6), 0.9);  // outwards
      const bool corner = rows[i][3] == "unbounded-second";
      EXPECT_EQ(rows[i][13].empty(), corner);
      EXPECT_EQ(rows[i][25].empty(), corner);
    }
    EXPECT_LE(most, error);
    EXPECT_GT(most, error / 2);
  }
  // Places of a file, and the same bits for any number of threads.
  const std::string at = directory.write("at.csv", "face,u,v\n7,0.25,0.5\n0,0.9,0.9\n").string();
  expect_failure(sublimit({"sample", in, "-s", "nielson", "--at", at, "-o", out}), 3,
                 {"at.csv:3", "outside the triangle"});
  expect_parts(expect_done(sublimit({"sample", in, "-s", "nielson", "--at", at, "--clamp", "-o", out})).out,
               {"1 moved"});
  const auto random = [&](const char* threads) {
    expect_done(
        sublimit({"sample", in, "-s", "nielson", "--random", "2000", "--threads", threads, "--quiet", "-o", out}));
    return read_file(out);
  };
  EXPECT_EQ(random("1"), random("2"));
}

TEST(CliNormalSurfaces, AreWrittenAsPointsWithNormals) {
  const TemporaryDirectory directory;
  const std::string in = directory.write("o.obj", octahedron).string(), out = (directory / "level.obj").string();
  expect_done(sublimit({"refine", in, "-s", "nielson", "-l", "3", "-o", out}));
  const Mesh level = read_obj(out);
  EXPECT_EQ(level.num_faces(), 8 * 64);
  const Points normals = read_obj_normals(out);
  ASSERT_EQ(normals.rows(), level.num_vertices());
  for (Index v = 0; v < level.num_vertices(); ++v) {
    EXPECT_NEAR(level.positions.row(v).norm(), 1, nielson_error);
    EXPECT_GT(normals.row(v).dot(level.positions.row(v)), 0.99);
  }
  // `limit` has the same points, and normals if asked for; .ply too.
  const std::string limit = (directory / "limit.obj").string();
  expect_parts(expect_done(sublimit({"limit", in, "-s", "nielson", "-l", "3", "-o", limit})).out,
               {"258 points", "level 3"});
  EXPECT_EQ(read_obj(limit).positions, level.positions);
  EXPECT_EQ(read_obj_normals(limit).rows(), 0);
  expect_done(sublimit({"limit", in, "-s", "piper", "-l", "1", "--normals", "-o", (directory / "limit.ply").string()}));

  const std::string matrix = (directory / "m.mtx").string();
  expect_failure(sublimit({"refine", in, "-s", "piper", "-l", "1", "-o", out, "--matrix", matrix}), 2,
                 {"m.mtx", "not linear: there is no matrix"});
  expect_failure(sublimit({"refine", in, "-s", "piper", "-l", "-1", "-o", out}), 2, {"-1"});
  expect_failure(sublimit({"refine", in, "-s", "piper", "-l", "40", "-o", out}), 4, {"40 levels of 8 triangles"});
  expect_failure(sublimit({"refine", in, "-s", "piper", "-l", "1", "--boundary", "none", "-o", out}), 2,
                 {"--boundary"});
  expect_failure(sublimit({"bake", in, "-s", "piper", "-l", "1", "-o", (directory / "t.safetensors").string()}), 2,
                 {"piper", "no matrix", "sublimit sample"});
}

TEST(CliNormalSurfaces, TakeEstimatedNormals) {
  const TemporaryDirectory directory;
  const std::string in = directory.write("o.obj", octahedron_points + octahedron_faces(false)).string(),
                    given = directory.write("n.obj", octahedron).string();
  const auto points = [&](const std::string& mesh, std::vector<std::string> more) {
    const std::string out = (directory / "out.obj").string();
    more.insert(more.begin(), {"refine", mesh, "-s", "nielson", "-l", "2", "-o", out});
    expect_done(sublimit(more));
    return read_obj(out).positions;
  };
  EXPECT_LE((points(in, {"--option", "normals=estimated"}) - points(given, {})).cwiseAbs().maxCoeff(), rounding(64));
}

TEST(CliNormalSurfaces, RefuseMeshesWithout) {
  const auto refused = [](const std::string& text, std::initializer_list<std::string_view> parts) {
    for (const char* scheme : {"nielson", "piper"}) expect_refused("m.obj", text, {"-s", scheme, "--quiet"}, 3, parts);
  };
  const std::string points =
      "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvn 0 0 1\nvn 1 0 0\nvn 0 0 0\nvn 0 0 -1\n";  // 8 lines
  refused(octahedron_points + octahedron_faces(false), {"m.obj", "no normals", "vn", "normals=estimated"});
  refused(points + "f 1//1 2//1 3//1 4//1\n", {"m.obj", "face 0 has 4 corners", "--triangulate"});
  refused(points + "f 1//1 2//1 3//2\nf 1//1 3//1 4//1\n", {"m.obj:10", "vertex 2", "another normal", "line 9"});
  refused(points + "f 1//1 2//1 3//1\nf 1//1 3//1 4\n", {"m.obj:10", "vertex 3", "without a normal"});
  refused(points + "f 1//1 2//2 3//1\n", {"m.obj", "edge (0,1)", "normal of vertex 1", "along the edge"});
  refused(points + "f 1//1 2//3 3//1\n", {"m.obj", "vertex 1", "length 0"});
  refused(points + "f 1//1 2//4 3//1\n", {"m.obj", "edge (0,1)", "opposite"});
  refused(points + "f 1//1 2//1 2//1\n", {"m.obj", "edge (1,1)", "same place"});
}

TEST(CliNormalSurfaces, AreDescribed) {
  const TemporaryDirectory directory;
  const std::string in = directory.write("o.obj", octahedron).string(),
                    bare = directory.write("b.obj", octahedron_points + octahedron_faces(false)).string();
  expect_parts(expect_done(sublimit({"info", in, "-s", "piper"})).out, {"piper:", "takes this mesh", "faces 0 to 7"});
  expect_parts(expect_no(sublimit({"info", bare, "-s", "piper"})).out, {"piper:", "no: there are no normals"});
  const auto info = nlohmann::json::parse(expect_done(sublimit({"info", in, "-s", "nielson", "--json"})).out);
  EXPECT_EQ(info["scheme"]["name"], "nielson");
  EXPECT_EQ(info["scheme"]["takes_mesh"], "yes");
  expect_failure(sublimit({"info", in, "-s", "nielsen"}), 2, {"nielson"});

  expect_parts(expect_done(sublimit({"schemes"})).out,
               {"\nnielson ", "\npiper ", "Nielson 1987", "Shirman", "normals=given"});
  int seen = 0;
  for (const auto& entry : nlohmann::json::parse(expect_done(sublimit({"schemes", "--json"})).out)) {
    if (entry["name"] != "nielson" && entry["name"] != "piper") continue;
    EXPECT_EQ(entry["linear"], false);
    EXPECT_EQ(entry["geometric_continuity"], 1);
    ++seen;
  }
  EXPECT_EQ(seen, 2);
}

}  // namespace
}  // namespace sublimit::testing
