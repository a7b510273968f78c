// SPDX-License-Identifier: Apache-2.0
// The program on curves: what it writes, and what it says when it cannot.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "laws/stationary.h"
#include "stencils/cli_program.h"
#include "sublimit/curves/schemes/curve_schemes.h"
#include "sublimit/io/detail/polygon_files.h"
#include "support/tolerance.h"

namespace sublimit::testing {
namespace {

const std::string zigzag = "x,y\n0,0\n1,2\n3,1\n4,0\n5,1\n6,3\n7,0\n";
const std::string square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nl 1 2 3 4 1\n";

TEST(CliCurves, ChaikinCutsCorners) {
  const TemporaryDirectory directory;
  const std::string in = directory.write("p.csv", "x,y\n0,0\n4,0\n4,4\n").string(),
                    out = (directory / "o.csv").string();
  expect_done(sublimit({"refine", in, "-s", "chaikin", "-l", "1", "-o", out}));
  EXPECT_EQ(read_file(out), "x,y\n1,0\n3,0\n4,1\n4,3\n");
  expect_done(sublimit({"refine", in, "-s", "chaikin", "-l", "1", "--closed", "-o", out}));
  EXPECT_EQ(read_file(out), "x,y\n1,0\n3,0\n4,1\n4,3\n3,3\n1,1\n");
  expect_done(sublimit({"refine", in, "-s", "chaikin", "-l", "1", "--option", "ends=interpolate", "-o", out}));
  EXPECT_EQ(read_file(out), "x,y\n0,0\n2,0\n4,2\n4,4\n");
}

TEST(CliCurves, ClosedObjStaysClosedAndTwiceOneIsOnceTwo) {
  const TemporaryDirectory directory;
  const std::string in = directory.write("p.obj", square).string();
  const auto path = [&](const char* name) { return (directory / name).string(); };
  for (const CurveScheme<double>& scheme : all_curve_schemes()) {
    if (!is_stationary(scheme)) continue;       // a level of the file is level 0 anew
    if (scheme.masks.unknowns() > 1) continue;  // an OBJ has no derivatives
    SCOPED_TRACE(scheme.name);
    expect_done(sublimit({"refine", in, "-s", scheme.name, "-l", "1", "-o", path("a.obj")}));
    expect_done(sublimit({"refine", path("a.obj"), "-s", scheme.name, "-l", "1", "-o", path("b.obj")}));
    expect_done(sublimit({"refine", in, "-s", scheme.name, "-l", "2", "-o", path("c.obj"), "--matrix", path("c.mtx")}));
    EXPECT_EQ(read_file(path("b.obj")), read_file(path("c.obj")));
    const ControlPolygon result = read_polygon(path("c.obj"));
    ASSERT_EQ(result.curves.size(), 1u);
    EXPECT_TRUE(result.curves[0].closed);
    EXPECT_EQ(result.num_points(), 16);
    expect_parts(read_file(path("c.mtx")), {"\n16 4 "});
  }
}

TEST(CliCurves, LimitsWithTangents) {
  const TemporaryDirectory directory;
  const std::string in = directory.write("p.csv", zigzag).string(), out = (directory / "o.csv").string();
  const Outcome outcome = expect_done(sublimit({"limit", in, "-s", "chaikin", "-l", "2", "--normals", "-o", out}));
  expect_parts(outcome.out, {"22 limit points of level 2", "0 without a tangent"});
  const ControlPolygon curve = read_polygon(out, true);
  EXPECT_EQ(curve.points.row(0), Eigen::RowVector2d(0.5, 1));  // the middle of the first segment
  for (Index i = 0; i < curve.num_points(); ++i) EXPECT_NEAR(curve.tangents.row(i).norm(), 1, rounding(1));
  expect_done(sublimit({"limit", in, "-s", "four-point", "--option", "tension=0", "--normals", "-o", out, "--quiet"}));
  EXPECT_EQ(count_of(read_file(out), ",,\n"), 5u);  // a polygon has tangents at its ends alone
  expect_failure(sublimit({"limit", in, "-s", "chaikin", "--normals", "-o", (directory / "o.obj").string()}), 2,
                 {"o.obj", "tangents", ".csv"});
}

TEST(CliCurves, HermiteTakesDerivatives) {
  const TemporaryDirectory directory;
  const std::string in = directory.write("p.csv", "x,y,dx,dy\n0,0,1,0\n1,1,1,0\n2,0,1,0\n").string();
  const auto path = [&](const char* name) { return (directory / name).string(); };
  const auto refined = [&](const std::string& from, const char* levels, const char* to) {
    expect_done(sublimit({"refine", from, "-s", "hermite-merrien", "-l", levels, "-o", path(to)}));
  };
  refined(in, "1", "a.csv");
  EXPECT_EQ(read_file(path("a.csv")),
            "x,y,dx,dy\n0,0,0.5,0\n0.5,0.5,0.5,0.75\n1,1,0.5,0\n1.5,0.5,0.5,-0.75\n2,0,0.5,0\n");
  refined(path("a.csv"), "1", "b.csv");
  refined(in, "2", "c.csv");
  EXPECT_EQ(read_file(path("b.csv")), read_file(path("c.csv")));
  expect_done(sublimit({"limit", in, "-s", "hermite-merrien", "-l", "0", "--normals", "-o", path("l.csv")}));
  const Points tangents = read_polygon(path("l.csv"), true).tangents;
  for (Index i = 0; i < 3; ++i) EXPECT_EQ(tangents.row(i), Eigen::RowVector2d(1, 0));
  expect_refused("p.csv", "0,0\n1,1\n2,0\n", {"-s", "hermite-merrien"}, 3, {"p.csv", "x,y,tx,ty"});
  expect_refused("p.csv", "x,y,dx,dy\n0,0,1,0\n1,1,1,0\n", {"-s", "hermite-merrien", "--option", "beta=1"}, 2,
                 {"beta=1", "C^1", "0.99"});
}

TEST(CliCurves, SchemesListsThem) {
  const std::string text = expect_done(sublimit({"schemes"})).out;
  const nlohmann::json json = nlohmann::json::parse(expect_done(sublimit({"schemes", "--json"})).out);
  for (const CurveScheme<double>& scheme : all_curve_schemes()) {
    expect_parts(text, {"\n" + scheme.name + " ", scheme.source});
    bool found = false;
    for (const auto& entry : json)
      if (entry["name"] == scheme.name) {
        found = true;
        EXPECT_EQ(entry["kind"], "curve");
        EXPECT_EQ(entry["regular_continuity"], scheme.claims.regular);
      }
    EXPECT_TRUE(found) << scheme.name;
  }
}

TEST(CliCurves, WrongKindOfInput) {
  const std::string quad = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n";
  expect_refused("p.csv", zigzag, {"-s", "catmull-clark"}, 3,
                 {"p.csv", "polygon", "catmull-clark refines meshes", "chaikin"});
  expect_refused("p.obj", square, {"-s", "loop"}, 3, {"p.obj", "polygon", "loop refines meshes", "four-point"});
  expect_refused("q.obj", quad, {"-s", "chaikin"}, 3, {"q.obj", "1 face", "no curves", "catmull-clark"});
  expect_refused("q.ply", "ply\n", {"-s", "chaikin"}, 3, {"q.ply", "a mesh", "chaikin refines curves"});
  expect_refused("q.dae", "", {"-s", "chaikin"}, 3, {"'.dae'", ".csv and .obj"});
  expect_refused("p.csv", zigzag, {"-s", "chakin"}, 2, {"chakin", "chaikin", "sublimit schemes"});
  expect_refused("p.csv", zigzag, {"-s", "chaikin", "--boundary", "none"}, 2, {"--boundary", "meshes"});
  expect_refused("p.csv", zigzag, {"-s", "chaikin", "--face-varying", "none"}, 2, {"--face-varying", "meshes"});
}

TEST(CliCurves, BadPoints) {
  expect_refused("p.csv", "0,0\n1,nan\n2,2\n", {"-s", "chaikin"}, 3, {"p.csv:2", "'nan'", "finite"});
  expect_refused("p.csv", "0,0\n1\n2,2\n", {"-s", "chaikin"}, 3, {"p.csv:2", "1 value"});
  expect_refused("p.csv", "", {"-s", "chaikin"}, 3, {"p.csv", "no points"});
  expect_refused("p.csv", "0,0\n1,1\n", {"-s", "chaikin"}, 3, {"2 points", "chaikin needs at least 3", "open"});
  expect_refused("p.csv", "0,0\n1,1\n", {"-s", "chaikin", "--closed"}, 3, {"2 points", "at least 3", "closed"});
  expect_refused("p.csv", "0,0\n1,1\n2,0\n", {"-s", "four-point"}, 3, {"3 points", "at least 4", "ends=linear"});
  expect_refused("p.csv", "0,0,0,0\n1,1,1,1\n2,0,0,0\n", {"-s", "chaikin"}, 2, {"out.obj", "3 coordinates", ".csv"});
}

TEST(CliCurves, AClosedPolygonMayComeBack) {
  const TemporaryDirectory directory;
  const std::string in = directory.write("p.csv", "0,0\n4,0\n4,4\n0,0\n").string(),
                    out = (directory / "o.csv").string();
  const Outcome outcome = sublimit({"refine", in, "-s", "chaikin", "-l", "1", "--closed", "-o", out});
  EXPECT_EQ(outcome.status, 0);
  expect_parts(outcome.err, {"p.csv", "curve 0", "first point", "left out"});
  EXPECT_EQ(read_polygon(out).num_points(), 6);
  expect_refused("p.csv", "0,0\n4,0\n4,4\n0,0\n", {"-s", "chaikin", "--closed", "--strict"}, 3,
                 {"p.csv", "first point"});
}

TEST(CliCurves, SegmentsOfAnObjAreJoined) {
  const TemporaryDirectory directory;
  const std::string points = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n", out = (directory / "o.obj").string();
  const auto refined = [&](const std::string& lines) {
    const std::string in = directory.write("p.obj", points + lines).string();
    expect_done(sublimit({"refine", in, "-s", "four-point", "--option", "ends=linear", "-l", "1", "-o", out}));
    return read_polygon(out);
  };
  EXPECT_EQ(refined("l 1 2\nl 2 3\nl 3 4\nl 4 1\n").curves[0].closed, true);
  EXPECT_EQ(refined("l 1 2\nl 2 3\nl 3 4\n").num_points(), 7);
  EXPECT_EQ(refined("l 1 2\nl 3 4\n").curves.size(), 2u);
  EXPECT_EQ(refined("l 1 2 3\nl 3 4\n").curves.size(), 2u);
}

TEST(CliCurves, TangentsOfAnySize) {
  const TemporaryDirectory directory;
  const std::string out = (directory / "o.csv").string();
  for (const char* exponent : {"e160", "e-160", "e-290", "e300"}) {
    std::string text;
    for (const char* point : {"0,0", "1,2", "3,1", "4,0"}) {
      const std::string word = point;
      text += word.substr(0, 1) + exponent + "," + word.substr(2) + exponent + "\n";
    }
    const std::string in = directory.write("p.csv", text).string();
    expect_done(sublimit({"limit", in, "-s", "chaikin", "-l", "1", "--normals", "-o", out, "--quiet"}));
    const ControlPolygon curve = read_polygon(out, true);
    for (Index i = 0; i < curve.num_points(); ++i)
      EXPECT_NEAR(curve.tangents.row(i).norm(), 1, rounding(1)) << exponent;
  }
}

TEST(CliCurves, TooManyPoints) {
  for (const char* scheme : {"chaikin", "lane-riesenfeld"})
    expect_refused("p.csv", zigzag, {"-s", scheme, "-l", "26"}, 4, {"26 levels of 7 points"});
  const std::string curve = "0,0,1,0\n1,1,0,1\n";
  expect_refused("p.csv", curve, {"-s", "hermite-incentre", "-l", "30"}, 4, {"30 levels of 2 points"});
}

TEST(CliCurves, BadOptions) {
  const std::string triangle = "v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\n";
  expect_refused("t.obj", triangle, {"-s", "loop", "--closed"}, 2, {"--closed is for curves", "loop"});
  expect_refused("p.csv", zigzag, {"-s", "chaikin", "--triangulate"}, 2, {"--triangulate is for meshes"});
  expect_refused("p.csv", zigzag, {"-s", "four-point", "--option", "tension=1", "--option", "tension=1"}, 2,
                 {"tension is given twice"});
  expect_refused("p.csv", zigzag, {"-s", "four-point", "--option", "tension=4"}, 2, {"tension=4", "0 to 77/25", "C^1"});
  expect_refused("p.csv", zigzag, {"-s", "four-point", "--option", "tension=abc"}, 2, {"tension=abc", "a number"});
  expect_refused("p.csv", zigzag, {"-s", "four-point", "--option", "tension=2", "--option", "ends=cubic"}, 2,
                 {"ends=cubic", "tension 2", "1.46"});
  expect_refused("p.csv", zigzag, {"-s", "chaikin", "--option", "ends=open"}, 2, {"ends=open", "free, interpolate"});
  expect_refused("p.csv", zigzag, {"-s", "chaikin", "--option", "tension=1"}, 2, {"chaikin", "tension", "ends"});
}

}  // namespace
}  // namespace sublimit::testing
