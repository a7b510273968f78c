// SPDX-License-Identifier: Apache-2.0
// Knot intervals through the program: tags and sidecars read and written back, tables, reports, what is refused.
#include <gtest/gtest.h>

#include "meshes/meshes.h"
#include "meshes/point_intervals.h"
#include "stencils/cli_program.h"
#include "sublimit/io/read_mesh.h"
#include "sublimit/io/write_mesh.h"
#include "sublimit/scheme/refine.h"
#include "sublimit/schemes/schemes.h"
#include "support/tolerance.h"

namespace sublimit::testing {
namespace {

const std::string scheme_name = "catmull-clark-intervals";

/// The cube with three intervals, one for each direction.
Mesh box() {
  Mesh mesh = cube();
  mesh.knot_intervals = {{0, 1, 1}, {0, 2, 2.5}, {0, 4, 4}};
  return mesh;
}

std::string mesh_file(const TemporaryDirectory& directory, const std::string& name, const Mesh& mesh) {
  write_mesh(directory / name, mesh);
  return (directory / name).string();
}

TEST(CliKnotIntervals, AreRefinedAndWrittenBack) {
  const TemporaryDirectory directory;
  const std::string mesh = mesh_file(directory, "box.obj", box());
  const auto path = [&](const char* name) { return (directory / name).string(); };
  expect_done(sublimit({"refine", mesh, "-s", scheme_name, "-l", "3", "-o", path("three.obj")}));
  expect_done(sublimit({"refine", mesh, "-s", scheme_name, "-l", "1", "-o", path("one.obj")}));
  expect_done(sublimit({"refine", path("one.obj"), "-s", scheme_name, "-l", "2", "-o", path("again.obj")}));
  const Mesh three = read_mesh(path("three.obj")), one = read_mesh(path("one.obj")),
             again = read_mesh(path("again.obj"));
  EXPECT_EQ(one.knot_intervals.size(), 48u);
  ASSERT_EQ(three.positions.rows(), again.positions.rows());
  EXPECT_LE((three.positions - again.positions).norm(), rounding(12));
  // And it is not what other schemes make of it.
  expect_done(sublimit({"refine", mesh, "-s", "catmull-clark", "-l", "3", "-o", path("equal.obj")}), true);
  EXPECT_GT((three.positions - read_mesh(path("equal.obj")).positions).norm(), 0.1);
}

TEST(CliKnotIntervals, AreReadFromTheSidecar) {
  const TemporaryDirectory directory;
  const std::string tagged = mesh_file(directory, "tagged.obj", box()),
                    plain = mesh_file(directory, "plain.obj", cube());
  directory.write("plain.json", R"({"knotIntervals": [1, 2.5, 4], "knotIntervalEdges": [0, 1, 0, 2, 0, 4]})");
  const auto refined = [&](const std::string& mesh) {
    const std::string out = (directory / "out.obj").string();
    expect_done(sublimit({"refine", mesh, "-s", scheme_name, "-l", "2", "-o", out}));
    return read_mesh(out).positions;
  };
  EXPECT_EQ((refined(tagged) - refined(plain)).norm(), 0);
  directory.write("plain.json", R"({"knotIntervals": [1, 2.5], "knotIntervalEdges": [0, 1, 0]})");
  expect_failure(sublimit({"info", plain}), 3, {"knotIntervalEdges: has 3 vertices", "should have 4"});
  directory.write("plain.json", R"({"knotIntervals": [-1], "knotIntervalEdges": [0, 1]})");
  expect_failure(sublimit({"info", plain}), 3, {"knotIntervals[0]: is -1", "positive"});
  directory.write("plain.json", R"({"knotIntervals": [1], "knotIntervalEdges": [0, 7]})");
  expect_failure(sublimit({"info", plain}), 3, {"no face has an edge between vertices 0 and 7"});
  directory.write("plain.json", R"({"knotIntervalEdges": [0, 1]})");
  expect_failure(sublimit({"info", plain}), 3, {"comes without knotIntervals"});
}

TEST(CliKnotIntervals, TablesAreThoseOfTheIntervals) {
  const TemporaryDirectory directory;
  const std::string mesh = mesh_file(directory, "box.obj", box());
  const auto path = [&](const char* name) { return (directory / name).string(); };
  expect_done(sublimit({"bake", mesh, "-s", scheme_name, "-l", "2", "-o", path("table.safetensors")}));
  expect_done(sublimit({"apply", path("table.safetensors"), mesh, "-o", path("applied.obj")}));
  expect_done(sublimit({"refine", mesh, "-s", scheme_name, "-l", "2", "-o", path("refined.obj")}));
  const Points applied = read_mesh(path("applied.obj")).positions, refined = read_mesh(path("refined.obj")).positions;
  EXPECT_LE((applied - refined).rowwise().norm().maxCoeff(), float_reference * diagonal(refined));
  expect_done(
      sublimit({"bake", mesh, "-s", scheme_name, "--grid", "3", "--derivatives", "1", "-o", path("grid.safetensors")}));
  expect_done(sublimit({"apply", path("grid.safetensors"), mesh, "-o", path("grid.csv")}));
  expect_done(sublimit({"sample", mesh, "-s", scheme_name, "--grid", "3", "-o", path("samples.csv")}));
}

/// Degree 2: the interval of vertex a towards b.
TEST(CliKnotIntervals, OfPointsAreWrittenBackAndBaked) {
  const TemporaryDirectory directory;
  const std::string scheme = "doo-sabin-intervals",
                    mesh = mesh_file(directory, "points.obj", with_point_intervals(octahedron(), 5));
  const auto path = [&](const char* name) { return (directory / name).string(); };
  const auto refined = [&](const std::string& from, const char* levels, const char* to) {
    expect_done(sublimit({"refine", from, "-s", scheme, "-l", levels, "-o", path(to)}));
    return read_mesh(path(to));
  };
  const Mesh three = refined(mesh, "3", "three.obj"), one = refined(mesh, "1", "one.obj"),
             again = refined(path("one.obj"), "2", "again.obj");
  EXPECT_EQ(one.knot_intervals.size(), 2 * 48u);  // both ends of the edges
  ASSERT_EQ(three.positions.rows(), again.positions.rows());
  EXPECT_LE((three.positions - again.positions).norm(), rounding(24));
  expect_done(sublimit({"bake", mesh, "-s", scheme, "-l", "3", "-o", path("table.safetensors")}));
  expect_done(sublimit({"apply", path("table.safetensors"), mesh, "-o", path("applied.obj")}));
  const Points applied = read_mesh(path("applied.obj")).positions;
  EXPECT_LE((applied - three.positions).rowwise().norm().maxCoeff(), float_reference * diagonal(applied));
  expect_done(sublimit({"sample", mesh, "-s", scheme, "--grid", "3", "--derivatives", "1", "-o", path("samples.csv")}));
  expect_done(sublimit({"limit", mesh, "-s", scheme, "-l", "1", "-o", path("limit.obj")}));

  const std::string text = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 2 0 0\nv 2 1 0\nf 1 2 3 4\nf 2 5 6 3\n";
  const std::string tags = "t knotinterval 2/1/0 1 0 2\nt knotinterval 2/1/0 1 4 3\n";
  const std::string bad = directory.write("bad.obj", text + tags).string();
  expect_failure(sublimit({"refine", bad, "-s", scheme, "-l", "1", "-o", path("none.obj")}), 3,
                 {"vertex 1", "is 3 towards vertex 4", "2 towards the opposite vertex 0"});
  EXPECT_FALSE(std::filesystem::exists(path("none.obj")));
}

TEST(CliKnotIntervals, OtherSchemesSayThatTheyKnowNone) {
  const TemporaryDirectory directory;
  const std::string mesh = mesh_file(directory, "box.obj", box());
  const Outcome outcome =
      sublimit({"refine", mesh, "-s", "catmull-clark", "-l", "1", "-o", (directory / "out.obj").string()});
  EXPECT_EQ(outcome.status, 0);
  EXPECT_NE(outcome.err.find("knot intervals ignored"), std::string::npos) << outcome.err;
}

TEST(CliKnotIntervals, WhatContradictsIsRefused) {
  const std::string text =
      "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 2 0 0\nv 2 1 0\nf 1 2 3 4\nf 2 5 6 3\n";  // lines 1 to 8
  const auto refuses = [&](const std::string& tags, std::initializer_list<std::string_view> parts) {
    const TemporaryDirectory directory;
    const std::string mesh = directory.write("mesh.obj", text + tags).string();
    expect_failure(sublimit({"refine", mesh, "-s", scheme_name, "-l", "1", "-o", (directory / "out.obj").string()}), 3,
                   parts);
    EXPECT_EQ(directory.num_files(), 1);
  };
  refuses("t knotinterval 2/1/0 0 1 2\nt knotinterval 2/1/0 3 2 3\n", {"face 0", "opposite edges", "2", "3"});
  refuses("t knotinterval 2/1/0 0 1 0\n", {"(0,1)", "t crease 2/1/0 0 1 10"});
  refuses("t knotinterval 2/1/0 0 1 -2\n", {"mesh.obj:9", "-2", "positive"});
  refuses("t knotinterval 2/1/0 0 1 nan\n", {"mesh.obj:9", "nan"});
  refuses("t knotinterval 2/1/0 0 1 inf\n", {"mesh.obj:9", "inf"});
  refuses("t knotinterval 2/1/0 0 4 1\n", {"mesh.obj:9", "no face has an edge between vertices 0 and 4"});
  refuses("t knotinterval 2/1/0 0 9 1\n", {"mesh.obj:9", "vertex 9 is out of range"});
  refuses("t knotinterval 1/1/0 0 1\n", {"mesh.obj:9", "t knotinterval 2/1/0 VERTEX VERTEX INTERVAL"});
}

TEST(CliKnotIntervals, ReportsSayWhatIsProvedAndWhatIsEvidence) {
  const TemporaryDirectory directory;
  const std::string json = (directory / "report.json").string();
  const Outcome levelled = sublimit({"analyze", "-s", scheme_name, "--valence", "3,5", "--json", json});
  EXPECT_EQ(levelled.status, 0) << levelled.err;
  EXPECT_NE(levelled.out.find("levelling: proved: from the third level on"), std::string::npos) << levelled.out;
  const Outcome halves =
      sublimit({"analyze", "-s", scheme_name, "--option", "levelling=off", "--valence", "3,5", "--json", json});
  EXPECT_EQ(halves.status, 0) << halves.err;
  EXPECT_NE(halves.out.find("halving: evidence-for: intervals stay unequal"), std::string::npos) << halves.out;
  const Outcome faces = sublimit({"analyze", "-s", "doo-sabin-intervals", "--valence", "3,5", "--json", json});
  EXPECT_EQ(faces.status, 0) << faces.err;
  EXPECT_NE(faces.out.find("levelling: proved: from the third level on the rows around extraordinary faces"),
            std::string::npos)
      << faces.out;
  const Outcome spirals =
      sublimit({"analyze", "-s", "doo-sabin-intervals", "--option", "levelling=off", "--valence", "3", "--json", json});
  EXPECT_NE(spirals.out.find("halving: unknown: intervals stay unequal, and the two eigenvalues may be complex"),
            std::string::npos)
      << spirals.out;
}

}  // namespace
}  // namespace sublimit::testing
