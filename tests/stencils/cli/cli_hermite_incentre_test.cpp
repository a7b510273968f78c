// SPDX-License-Identifier: Apache-2.0
// The program on points with tangents: what the scheme without a matrix writes, and what it says when it cannot.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "stencils/cli_program.h"
#include "sublimit/io/detail/polygon_files.h"
#include "support/tolerance.h"

namespace sublimit::testing {
namespace {

/// A quarter of the unit circle, then an inflection.
const std::string curve = "x,y,tx,ty\n1,0,0,1\n0,1,-1,0\n-1,3,-1,0\n";

void expect_hermite_refused(const std::string& name, const std::string& text,
                            std::initializer_list<std::string_view> parts, int status = 3,
                            std::vector<std::string> more = {}) {
  more.insert(more.end(), {"-s", "hermite-incentre"});
  expect_refused(name, text, more, status, parts, "o.csv");
}

TEST(CliHermiteIncentre, RefinesAndGoesOn) {
  const TemporaryDirectory directory;
  const std::string in = directory.write("p.csv", curve).string();
  const auto path = [&](const char* name) { return (directory / name).string(); };
  const auto run = [&](const char* command, const std::string& from, const char* levels, const char* to,
                       std::vector<std::string> more = {"--quiet"}) {
    std::vector<std::string> all{command, from, "-s", "hermite-incentre", "-l", levels, "-o", path(to)};
    all.insert(all.end(), more.begin(), more.end());
    return expect_done(sublimit(all), more.empty());
  };
  expect_parts(run("refine", in, "1", "a.csv", {}).err, {"note", "p.csv", "1 of 2 segments have no incentre"});
  run("refine", path("a.csv"), "2", "b.csv");
  run("refine", in, "3", "c.csv");
  EXPECT_EQ(read_file(path("b.csv")), read_file(path("c.csv")));
  const std::string refined = read_file(path("a.csv"));
  EXPECT_TRUE(refined.starts_with("x,y,tx,ty\n1,0,0,1\n0.7071067811865")) << refined;

  run("limit", in, "3", "d.csv", {"--normals", "--quiet"});
  const ControlPolygon fine = read_polygon(path("c.csv"), true), limit = read_polygon(path("d.csv"), true);
  EXPECT_LE((fine.points - limit.points).cwiseAbs().maxCoeff(), rounding(8));
  EXPECT_LE((fine.tangents - limit.tangents).cwiseAbs().maxCoeff(), rounding(8));
  run("limit", in, "3", "e.csv");
  EXPECT_EQ(read_polygon(path("e.csv")).points, limit.points);

  run("refine", in, "1", "f.obj", {"--closed", "--quiet"});
  const ControlPolygon closed = read_polygon(path("f.obj"));
  EXPECT_EQ(closed.num_points(), 6);
  EXPECT_TRUE(closed.curves[0].closed);
}

TEST(CliHermiteIncentre, RefusesBadCurves) {
  expect_hermite_refused("p.csv", "0,0,1,0\n1,0,1,0\n2,0,3,4\n", {"p.csv:3", "point 2", "length 5", "length 1"});
  expect_hermite_refused("p.csv", "x,y,tx,ty\n0,0,1,0\n1,0,0,0\n", {"p.csv:3", "point 1", "length 0"});
  expect_hermite_refused("p.csv", "0,0,1,0\n\n# again\n1,0,1,0\n1,0,0,1\n", {"p.csv:1", "1 point", "at least 2"});
  expect_hermite_refused("p.csv", "0,0,1,0\n1,0,1,0\n1,0,0,1\n", {"p.csv:3", "points 1 and 2", "equal", "leave one"});
  expect_hermite_refused("p.csv", "0,0,1,0\n1,0,nan,0\n", {"p.csv:2", "'nan'"});
  expect_hermite_refused("p.csv", "0,0,1,0\n", {"p.csv:1", "1 point", "at least 2"});
  expect_hermite_refused("p.csv", "x,y\n0,0\n1,0\n", {"p.csv:1", "2 columns", "x,y,tx,ty"});
  expect_hermite_refused("p.csv", "0,0,0\n1,0,0\n", {"p.csv:1", "3 columns", "x,y,tx,ty"});
  expect_hermite_refused("p.csv", "0,0,0,0,1,0,0,0\n1,0,0,0,1,0,0,0\n", {"p.csv", "4", "x,y,z,tx,ty,tz"});
  expect_hermite_refused("p.obj", "v 0 0 0\nv 1 0 0\nl 1 2\n", {"p.obj", "tangents", "x,y,tx,ty"});
  expect_hermite_refused("p.csv", "", {"p.csv", "no points"});
  expect_hermite_refused("p.csv", curve, {"hermite-incentre has no option 'a'"}, 2, {"--option", "a=1"});
  expect_hermite_refused("p.csv", curve, {"--boundary", "meshes"}, 2, {"--boundary", "none"});
}

TEST(CliHermiteIncentre, HasNoMatrixAndIsListed) {
  const TemporaryDirectory directory;
  const std::string in = directory.write("p.csv", curve).string(), out = (directory / "o.obj").string();
  expect_failure(sublimit({"refine", in, "-s", "hermite-incentre", "-l", "1", "-o", out, "--matrix",
                           (directory / "m.mtx").string()}),
                 2, {"m.mtx", "it is not linear: there is no matrix"});
  expect_failure(sublimit({"refine", in, "-s", "hermite-incenter", "-l", "1", "-o", (directory / "o.csv").string()}), 2,
                 {"hermite-incentre"});
  expect_failure(sublimit({"info", in, "-s", "hermite-incentre"}), 2, {"hermite-incentre refines curves"});
  expect_failure(sublimit({"refine", in, "-s", "hermite-incentre", "-l", "31", "-o", out}), 4,
                 {"31 levels", "use at most 2"});
  expect_failure(sublimit({"refine", in, "-s", "hermite-incentre", "-l", "-1", "-o", out}), 2, {"-1"});
  EXPECT_EQ(directory.num_files(), 1);
  expect_parts(expect_done(sublimit({"schemes"})).out, {"\nhermite-incentre ", "G^1", "circles", "Not linear"});
  for (const auto& entry : nlohmann::json::parse(expect_done(sublimit({"schemes", "--json"})).out))
    if (entry["name"] == "hermite-incentre") {
      EXPECT_EQ(entry["linear"], false);
      return;
    }
  ADD_FAILURE() << "not in the JSON";
}

}  // namespace
}  // namespace sublimit::testing
