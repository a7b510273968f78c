// SPDX-License-Identifier: Apache-2.0
// `sublimit sample` of curves at places in their own parameters, curve,t[,side].
#include <gtest/gtest.h>

#include <sstream>

#include "stencils/cli_program.h"
#include "stencils/recipes/recipe_samples.h"

namespace sublimit::testing {
namespace {

/// x = t on [0, 4], broken at 1: y = t, then 2 - t. And the parabola y = t^2/4 over [2, 6].
const std::string curves_of_an_obj =
    "v 0 0 0\nv 1 1 0\nv 4 -2 0\nv 2 1 0\nv 4 3 0\nv 6 9 0\n"
    "cstype bspline\ndeg 1\ncurv 0 4 1 2 3\nparm u 0 0 1 4 4\nend\n"
    "cstype bezier\ndeg 2\ncurv 2 6 4 5 6\nparm u 2 6\nend\n";
const std::string curves_of_recipes = R"({"recipes": [
  {"kind": "bspline_curve", "degree": 1, "knots": [0, 0, 1, 4, 4], "points": [[0, 0, 0], [1, 1, 0], [4, -2, 0]]},
  {"kind": "bezier_curve", "degree": 2, "domain": [2, 6], "points": [[2, 1, 0], [4, 3, 0], [6, 9, 0]]}]})";

class CurvePlaces : public ::testing::Test {
 protected:
  CurvePlaces() {
    directory_.write("c.obj", curves_of_an_obj);
    directory_.write("c.json", curves_of_recipes);
  }
  std::string path(std::string_view name) const { return (directory_ / name).string(); }
  Outcome sampled(const std::string& file, const std::string& places, std::vector<std::string> more = {}) const {
    directory_.write("at.csv", places);
    more.insert(more.begin(), {"sample", path(file), "--at", path("at.csv"), "-o", path("s.csv"), "--quiet"});
    return sublimit(more);
  }
  std::string samples(const std::string& file, const std::string& places,
                      const std::vector<std::string>& more = {}) const {
    expect_done(sampled(file, places, more));
    return read_file(path("s.csv"));
  }
  TemporaryDirectory directory_;
};

TEST_F(CurvePlaces, AreParametersOfTheKnots) {
  for (const char* file : {"c.obj", "c.json"}) {
    SCOPED_TRACE(file);
    EXPECT_EQ(samples(file, "curve,t\n0,0.5\n0,2.5\n0,4\n0,0\n", {"--derivatives", "1"}),
              "curve,t,status,x,y,z,xt,yt,zt,nx,ny,nz\n"
              "0,0.5,regular,0.5,0.5,0,1,1,0,,,\n"
              "0,2.5,regular,2.5,-0.5,0,1,-1,0,,,\n"
              "0,4,regular,4,-2,0,1,-1,0,,,\n"
              "0,0,regular,0,0,0,1,1,0,,,\n");
    expect_parts(samples(file, "curve,t\n1,2\n1,4\n1,6\n"),
                 {"\n1,2,regular,2,1,0,", "\n1,4,regular,4,4,0,", "\n1,6,regular,6,9,0,"});
  }
}

TEST_F(CurvePlaces, HaveDerivativesPerUnitOfTheParameter) {
  const std::string own = samples("c.json", "curve,t\n1,3\n", {"--derivatives", "2"});
  // x = t, y = t^2/4: (1, 3/2) and (0, 1/2); per unit of the segment, of length 4, these are (4, 6) and (0, 8).
  EXPECT_NE(own.find("\n1,3,regular,3,2.25,0,1,1.5,0,0,0.5,0,"), std::string::npos) << own;
  const std::string unit = samples("c.json", "segment,t\n2,0.25\n", {"--derivatives", "2"});
  EXPECT_NE(unit.find("\n2,0.25,regular,3,2.25,0,4,6,0,0,8,0,"), std::string::npos) << unit;
}

TEST_F(CurvePlaces, HaveSidesAtKnots) {
  for (const char* file : {"c.obj", "c.json"})
    EXPECT_EQ(samples(file, "curve,t,side\n0,1,-\n0,1,+\n0,1,\n0,4,+\n", {"--derivatives", "1"}),
              "curve,t,side,status,x,y,z,xt,yt,zt,nx,ny,nz\n"
              "0,1,-,crease,1,1,0,1,1,0,,,\n"
              "0,1,+,crease,1,1,0,1,-1,0,,,\n"
              "0,1,,crease,1,1,0,1,-1,0,,,\n"
              "0,4,+,regular,4,-2,0,1,-1,0,,,\n");
  // The start of a closed curve is its end.
  directory_.write("closed.json", sample_recipe("bspline_curve"));
  const std::string closed = samples("closed.json", "curve,t,side\n0,0,-\n0,3,-\n0,0,+\n", {"--derivatives", "2"});
  std::istringstream lines(closed);
  std::string header, before, end, behind;
  std::getline(lines, header), std::getline(lines, before), std::getline(lines, end), std::getline(lines, behind);
  EXPECT_EQ(before.substr(before.find("-,") + 2), end.substr(end.find("-,") + 2));
  EXPECT_NE(before.substr(before.find("-,") + 2), behind.substr(behind.find("+,") + 2)) << "second derivatives jump";
}

TEST_F(CurvePlaces, OfEveryKindOfCurve) {
  for (const auto& [kind, fields] : sample_fields()) {
    if (!kind.ends_with("_curve") && !kind.starts_with("interpolate")) continue;
    SCOPED_TRACE(kind);
    directory_.write("r.json", sample_recipe(kind));
    // Both ends of the domain, which the refusal of a place beyond tells.
    const Outcome refused = sampled("r.json", "curve,t\n0,1e9\n");
    EXPECT_EQ(refused.status, 3);
    const size_t at = refused.err.find("is outside the domain, ");
    ASSERT_NE(at, std::string::npos) << refused.err;
    std::istringstream words(refused.err.substr(at + 23));
    std::string begin, to, end;
    words >> begin >> to >> end;
    const std::string own = samples("r.json", "curve,t\n0," + begin + "\n0," + end + "\n");
    const size_t segments = count_of(samples("r.json", "curve,t\n0," + begin + "\n"), "\n");
    EXPECT_EQ(segments, 2u);
    expect_done(sublimit({"sample", path("r.json"), "--grid", "2", "-o", path("g.csv"), "--quiet"}));
    std::istringstream grid(read_file(path("g.csv"))), asked(own);
    std::vector<std::string> all, ends;
    for (std::string line; std::getline(grid, line);) all.push_back(line);
    for (std::string line; std::getline(asked, line);) ends.push_back(line);
    const auto found = [](const std::string& row) { return row.substr(row.find(',', row.find(',') + 1)); };
    ASSERT_EQ(ends.size(), 3u);
    EXPECT_EQ(found(ends[1]), found(all[1]));
    EXPECT_EQ(found(ends[2]), found(all.back()));
  }
}

TEST_F(CurvePlaces, RefuseWhatIsNone) {
  const auto refused = [&](const std::string& places, std::initializer_list<std::string_view> parts) {
    for (const char* file : {"c.obj", "c.json"}) {
      SCOPED_TRACE(places);
      expect_failure(sampled(file, places), 3, parts);
      EXPECT_EQ(directory_.num_files(), 3) << "nothing is written";
    }
  };
  refused("curve,t\n0,0\n2,0\n", {"at.csv:3: curve 2 does not exist; curves are 0 to 1"});
  refused("curve,t\n-1,0\n", {"at.csv:2: curve -1 does not exist; curves are 0 to 1"});
  refused("curve,t\nx,0\n", {"at.csv:2: curve 'x' is not a whole number; curves are 0 to 1"});
  refused("curve,t\n0,4.5\n", {"at.csv:2: curve 0: parameter 4.5 is outside the domain, 0 to 4"});
  refused("curve,t\n0,1\n1,1.5\n", {"at.csv:3: curve 1: parameter 1.5 is outside the domain, 2 to 6"});
  refused("curve,t\n0,nan\n", {"at.csv:2: t is 'nan'; it should be a finite number"});
  refused("curve,t\n0,\n", {"at.csv:2: t is missing"});
  refused("curve,t\n0,1,+\n", {"at.csv:2: 3 fields, not 2; a row should be curve,t"});
  refused("curve,t,side\n0,1,+-\n", {"at.csv:2: side '+-'; it should be + or -, or empty"});
  refused("curve,t,side\n0,1,-\n0,1,left\n", {"at.csv:3: side 'left'; it should be + or -, or empty"});
  refused("curve,u\n0,1\n", {"at.csv:1", "segment,t or curve,t or curve,t,side"});
  refused("t,curve\n0,1\n", {"at.csv:1", "segment,t or curve,t or curve,t,side"});
  refused("segment,t\n3,0.5\n", {"at.csv:2: segment 3 does not exist; segments are 0 to 2"});
  expect_failure(sampled("c.obj", "curve,t\n0,9\n", {"--clamp"}), 2, {"--clamp is for places segment,t", "curve,t"});
  // Schemes for polygons have segments alone.
  directory_.write("p.csv", "0,0\n1,0\n1,1\n0,1\n");
  expect_failure(sampled("p.csv", "curve,t\n0,0\n", {"-s", "chaikin"}), 3, {"at.csv:1", "the header segment,t"});
}

}  // namespace
}  // namespace sublimit::testing
