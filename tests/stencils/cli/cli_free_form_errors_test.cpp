// SPDX-License-Identifier: Apache-2.0
// Free-form files and recipes that are wrong or degenerate, through the program: what every command says of them, with
// which status; and what is accepted, with which words.
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "stencils/cli_program.h"
#include "stencils/recipes/recipe_samples.h"
#include "sublimit/base/detail/format_number.h"

namespace sublimit::testing {
namespace {

/// A file on which commands are tried.
class WrongShape {
 public:
  WrongShape(std::string_view name, const std::string& text) : shape(directory.write(name, text).string()) {}
  std::string path(std::string_view name) const { return (directory / name).string(); }
  Outcome sampled(std::vector<std::string> more) const {
    more.insert(more.begin(), {"sample", shape, "-o", path("out.csv")});
    return sublimit(more);
  }
  /// Lines of the samples behind the header.
  std::vector<std::string> rows(const std::vector<std::string>& more, bool warned = false) const {
    expect_done(sampled(more), warned);
    std::istringstream text(read_file(path("out.csv")));
    std::vector<std::string> lines;
    for (std::string line; std::getline(text, line);) lines.push_back(line);
    return {lines.begin() + (lines.empty() ? 0 : 1), lines.end()};
  }
  /// Every command that reads it fails so, in one line, and leaves nothing behind.
  void expect_refused_by_all(std::initializer_list<std::string_view> parts) const {
    const bool recipe = shape.ends_with(".json");
    std::vector<std::vector<std::string>> commands{{"info", shape},
                                                   {"info", shape, "--json"},
                                                   {"sample", shape, "--grid", "3", "-o", path("o.csv")},
                                                   {"bake", shape, "--grid", "3", "-o", path("o.safetensors")},
                                                   {"refine", shape, "-l", "1", "-o", path("o.obj")},
                                                   {"limit", shape, "-o", path("o.ply")},
                                                   {"analyze", shape, "-o", path("o.html")}};
    if (recipe) commands.push_back({"construct", shape, "-o", path("o.obj")});
    for (const std::vector<std::string>& command : commands) {
      SCOPED_TRACE(command[0]);
      const Outcome outcome = sublimit(command);
      expect_failure(outcome, 3, parts);
      EXPECT_EQ(count_of(outcome.err, "\n"), 1u) << outcome.err;
      EXPECT_EQ(directory.num_files(), 1);
    }
  }

  TemporaryDirectory directory;
  const std::string shape;
};

struct WrongText {
  std::string text;
  std::initializer_list<std::string_view> parts;
};

/// Nine points, lines 1 to 9.
const std::string nine_vertices = "v 0 0 0\nv 1 0 0\nv 2 0 0\nv 0 1 0\nv 1 1 1\nv 2 1 0\nv 0 2 0\nv 1 2 0\nv 2 2 0\n";

/// A biquadratic surface behind them: `surf` is line 12, `parm` 13 and 14.
std::string biquadratic(const std::string& type, const std::string& u, const std::string& v) {
  return nine_vertices + "cstype " + type + "\ndeg 2 2\nsurf 0 1 0 1 1 2 3 4 5 6 7 8 9\nparm u " + u + "\nparm v " + v +
         "\nend\n";
}

TEST(CliFreeFormErrors, OfFilesHaveALineAndWhatWouldBeRight) {
  const std::string good = "0 0 0 1 1 1";
  for (const WrongText& wrong : std::initializer_list<WrongText>{
           {biquadratic("bspline", "0 0 1 1 1", good), {"shape.obj:12", "9 control points", "parm u of 5 values"}},
           {biquadratic("bspline", "0 0 0 0 1 1 1", good), {"shape.obj:12", "parm u of 7 values", "4 x 3 = 12"}},
           {biquadratic("bspline", "0 0 0 1 0.5 1", good), {"shape.obj:13", "value 5 is 0.5 after 1", "not fall"}},
           {biquadratic("bspline", good, "0 0 0 1 1 inf"), {"shape.obj:14", "'inf'", "finite"}},
           {biquadratic("bspline", good, "0 0 nan 1 1 1"), {"shape.obj:14", "'nan'", "finite"}},
           {biquadratic("bspline", "2 2 2 2 2 2", good), {"shape.obj:13", "domain", "2 to 2", "not be empty"}},
           {biquadratic("bspline", "0 0 0 0 0 1", good), {"shape.obj:13", "domain", "not be empty"}},
           {biquadratic("bezier", "1 0", "0 1"), {"shape.obj:13", "value 2 is 0 after 1", "should rise"}},
           {biquadratic("bezier", "0 1 2", "0 1"), {"shape.obj:12", "belong to 5 x 3 = 15"}},
           {biquadratic("nurbs", good, good), {"shape.obj:10", "unknown cstype 'nurbs'", "'bspline'"}},
           {nine_vertices + "cstype bspline\ndeg 2 2\nsurf 0 1 0 1 1 2 3 4 5 6 7 8 9\nparm u " + good + "\nend\n",
            {"shape.obj:12", "no 'parm v'"}},
           {nine_vertices + "cstype bspline\ndeg 2 2\nparm u 0 0 0 1 1 1\nsurf 0 1 0 1 1 2 3 4 5 6 7 8 9\nend\n",
            {"shape.obj:12", "'parm' belongs to no element"}},
           {nine_vertices + "cstype bspline\ndeg 26 1\nsurf 0 1 0 1 " +
                [] {
                  std::string points;
                  for (int i = 0; i < 54; ++i) points += "1 ";
                  return points + "\nparm u";
                }() +
                [] {
                  std::string knots;
                  for (int i = 0; i < 54; ++i) knots += i < 27 ? " 0" : " 1";
                  return knots + "\nparm v 0 0 1 1\nend\n";
                }(),
            {"shape.obj:12", "degree 26", "0 to 25"}},
           {"v 0 0 0 0\nv 1 0 0 0\ncstype rat bezier\ndeg 1 1\nsurf 0 1 0 1 1 2 1 2\nparm u 0 1\nparm v 0 1\nend\n",
            {"shape.obj:5", "the weights of all control points are 0"}},
           {"v 0 0 0\nv 1 0 nan\ncstype bezier\ndeg 1 1\nsurf 0 1 0 1 1 2 1 2\nparm u 0 1\nparm v 0 1\nend\n",
            {"shape.obj:2", "'nan'", "finite"}},
           {nine_vertices + "cstype bezier\ndeg 1 1\nsurf 0 1 0 1 1 2 4 10\nparm u 0 1\nparm v 0 1\nend\n",
            {"shape.obj:12", "index 10 is out of range", "9 vertices"}},
       }) {
    SCOPED_TRACE(wrong.text);
    WrongShape("shape.obj", wrong.text).expect_refused_by_all(wrong.parts);
  }
}

std::string altered_recipe(std::string_view kind, std::string_view from, std::string_view to) {
  std::string text = sample_recipe(std::string(kind));
  const size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from << " in " << text;
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

TEST(CliFreeFormErrors, OfRecipesHaveTheirNumberNameAndField) {
  for (const WrongText& wrong : std::initializer_list<WrongText>{
           // Knots: too few, falling, not finite, too often, without a domain.
           {altered_recipe("cone", "[0, 0, 0, 1, 1, 1]", "[0, 0, 0]"),
            {"r.json: recipe 0 (cone): curve.knots: 3 knots for 3 control points of degree 2: 6 are needed, or 4"}},
           {altered_recipe("cone", "[0, 0, 0, 1, 1, 1]", "[0, 0, 1, 0, 1, 1]"),
            {"curve.knots: knot 3 is 0", "not fall"}},
           {altered_recipe("cone", "[0, 0, 0, 1, 1, 1]", R"([0, 0, 0, 1, 1, "inf"])"), {"curve.knots[5]: is \"inf\""}},
           {altered_recipe("bspline_curve",
                           R"("knots": [0, 1, 2, 3], "closed": true, "points": [[0, 0], [1, 0], [0, 1]])",
                           R"("knots": [0, 0, 0, 1, 1, 1, 1, 2, 2, 2], )"
                           R"("points": [[0, 0], [1, 0], [0, 1], [1, 1], [2, 1], [2, 2], [3, 2]])"),
            {"knots: knot 3 is 1, which occurs 4 times", "at most 3", "control point 3 has no influence"}},
           {altered_recipe("cone", "[0, 0, 0, 1, 1, 1]", "[3, 3, 3, 3, 3, 3]"), {"curve.knots:", "must have a length"}},
           // Weights and numbers.
           {altered_recipe("nurbs_surface", "[[0, 0, 0, 1], [1, 0, 0, 1], [0, 2, 0, 2], [2, 2, 2, 2]]",
                           "[[0, 0, 0, 0], [1, 0, 0, 0], [0, 2, 0, 0], [2, 2, 2, 0]]"),
            {"homogeneous: all weights are 0"}},
           {altered_recipe("bezier_surface", "[1, 1, 1]", "[1, 1, NaN]"), {"r.json:1: not JSON"}},
           {altered_recipe("bezier_surface", "[1, 1, 1]", R"([1, 1, "nan"])"),
            {"points[3][2]: is \"nan\"", "fraction"}},
           {altered_recipe("bezier_surface", "[1, 1, 1]", "[1, 1, null]"), {"points[3][2]: is null"}},
           // Boundaries and their fields.
           {altered_recipe("coons_bilinear", "[[0, 0, 0], [1, 0, 0]]", "[[0, 0, 3], [1, 0, 0]]"),
            {"recipe 0 (coons_bilinear): corner (0,0)", "3 apart"}},
           {altered_recipe("coons_general", R"("twists": [[0, 0, 1])", R"("twists": [[0, 0, 3])"),
            {"corner (0,0)", "twist"}},
           {altered_recipe("coons_general", R"("xv0": {"degree": 1, "knots": [0, 0, 1, 1], "points": [[0, 1, 0])",
                           R"("xv0": {"degree": 1, "knots": [0, 0, 1, 1], "points": [[0, 3, 0])"),
            {"corner (0,0)", "xv0"}},
           // Interpolation: nodes that are equal; nodes where a function has no support (Schoenberg, Whitney).
           {altered_recipe("lagrange_curve", "[0, 1, 3]", "[0, 3, 3]"), {"nodes 1 and 2 are both 3"}},
           {altered_recipe("loft", "[0, 1, 2]", "[0, 1, 1]"), {"parameters 1 and 2 are both 1"}},
           {altered_recipe("interpolate_bspline", R"("degree": 2)", R"("degree": 2, "knots": [0, 0, 1.5, 2, 3, 4, 4])"),
            {"parameter 0 is 0", "knots 0 and 3"}},
           // Revolution: arcs of 180 degrees, no sweep, more than a turn.
           {altered_recipe("revolution", R"("start_degrees")", R"("arcs": 2, "start_degrees")"),
            {"2 arcs of 360 degrees", "less than 180 degrees", "3 or more"}},
           {altered_recipe("revolution", "360", "0"), {"a sweep of 0 degrees"}},
           {altered_recipe("revolution", "360", "360.5"), {"a sweep of 360.5 degrees"}},
           {altered_recipe("revolution", "360", "-361"), {"a sweep of -361 degrees"}},
           // Recipes in recipes, and kinds that there are not.
           {R"({"recipes": [)" + sample_recipe("cone") + R"(, {"recipes": []}]})", {"recipe 1", "do not nest"}},
           {altered_recipe("ruled", R"("c0": {)", R"("c0": {"kind": "bezier_curve", )"),
            {"recipe 0 (ruled): c0: is a recipe of its own", "do not nest"}},
           {R"({"kind": "nurb_surface"})", {"unknown kind \"nurb_surface\"", "nurbs_surface"}},
           {R"({"name": "hull"})", {"recipe 0 'hull'", "kind is missing"}},
           {altered_recipe("cone", R"("apex")", R"("apx")"), {"the field apex is missing"}},
           {sample_recipe("cone", R"("colour": 3, )"), {"unknown field \"colour\""}},
       }) {
    SCOPED_TRACE(wrong.text);
    WrongShape("r.json", wrong.text).expect_refused_by_all(wrong.parts);
  }
}

/// A line from (0,1,2) to (1,1,2) whose weights are 1 and -1: w = 1 - 2t.
TEST(CliFreeFormErrors, PolesOfCurvesHaveNoPoint) {
  const WrongShape files[] = {
      {"c.obj", "v 0 1 2 1\nv 1 1 2 -1\ncstype rat bezier\ndeg 1\ncurv 0 1 1 2\nparm u 0 1\nend\n"},
      {"c.json",
       R"({"kind": "nurbs_curve", "degree": 1, "knots": [0, 0, 1, 1], "homogeneous": [[0, 1, 2, 1], [-1, -1, -2, -1]]})"}};
  for (const WrongShape& on : files) {
    SCOPED_TRACE(on.shape);
    EXPECT_EQ(on.rows({"--grid", "3"}, true),
              (std::vector<std::string>{"0,0,regular,0,1,2,,,", "0,0.5,pole,,,,,,", "0,1,regular,1,1,2,,,"}));
    EXPECT_EQ(on.rows({"--grid", "3", "--derivatives", "2"}, true)[1], "0,0.5,pole,,,,,,,,,,,,");
    const std::string own = on.directory.write("own.csv", "curve,t\n0,0.5\n").string();
    EXPECT_EQ(on.rows({"--at", own, "--derivatives", "1"}, true), (std::vector<std::string>{"0,0.5,pole,,,,,,,,,"}));
  }
  expect_parts(files[0].sampled({"--grid", "3"}).err, {"c.obj:5", "weight -1", "there may be poles"});
  expect_parts(files[1].sampled({"--grid", "3"}).err, {"1 weights are not positive", "poles"});
}

TEST(CliFreeFormErrors, NetsThatFilesCannotHoldAreNamed) {
  // w = 1 - 2u: of the finer net the middle row has the weight 0.
  const WrongShape pole("s.obj",
                        "v 0 0 0 1\nv 1 0 0 -1\nv 0 1 0 1\nv 1 1 0 -1\ncstype rat bezier\ndeg 1 1\n"
                        "surf 0 1 0 1 1 2 3 4\nparm u 0 1\nparm v 0 1\nend\n");
  const auto quiet = [](std::vector<std::string> command) {
    command.push_back("--quiet");
    return sublimit(command);
  };
  expect_failure(quiet({"limit", pole.shape, "-l", "1", "-o", pole.path("o.ply")}), 3,
                 {"s.obj: point 1 of the net tends to a pole"});
  expect_failure(quiet({"refine", pole.shape, "-l", "1", "-o", pole.path("o.ply")}), 3,
                 {"s.obj: point 1 of the net has the weight 0", "write an .obj"});
  EXPECT_EQ(pole.directory.num_files(), 1);
  expect_done(quiet({"refine", pole.shape, "-l", "1", "-o", pole.path("o.obj")}));
  const WrongShape steps("r.json", R"({"kind": "bspline_surface", "degree": [0, 1], "shape": [2, 2],)"
                                   R"("knots_u": [0, 1, 2], "knots_v": [0, 0, 1, 1],)"
                                   R"("points": [[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0]]})");
  expect_failure(sublimit({"refine", steps.shape, "-l", "1", "-o", steps.path("o.obj")}), 3,
                 {"r.json: patch 0 has degree 0 in u, which OBJ does not have"});
  const Outcome analyzed = sublimit({"analyze", steps.shape});
  expect_failure(analyzed, 3, {"r.json: recipe 0 (bspline_surface): no exact net"});
  EXPECT_EQ(count_of(analyzed.err, "r.json"), 1u) << analyzed.err;
  const WrongShape heavy("h.obj", "v 0 0 0\nv 3 0 0 1e308\ncstype rat bezier\ndeg 1\ncurv 0 1 1 2\nparm u 0 1\nend\n");
  expect_failure(heavy.sampled({"--grid", "3"}), 3, {"h.obj: vertex 2", "1e+308", "scale the weights down"});
}

// Control vector (0,1) between (1,0) and (-1,0): half of a circle, and no pole though a weight is 0.
TEST(CliFreeFormErrors, AWeightOfZeroIsADirection) {
  for (const auto& [name, text] :
       {std::pair<const char*, std::string>{
            "c.obj", "v 1 0 0 1\nv 0 1 0 0\nv -1 0 0 1\ncstype rat bezier\ndeg 2\ncurv 0 1 1 2 3\nparm u 0 1\nend\n"},
        {"c.json", R"({"kind": "nurbs_curve", "degree": 2, "knots": [0, 0, 0, 1, 1, 1],)"
                   R"("homogeneous": [[1, 0, 0, 1], [0, 1, 0, 0], [-1, 0, 0, 1]]})"}}) {
    const WrongShape on(name, text);
    const std::vector<std::string> rows = on.rows({"--grid", "3"}, true);
    ASSERT_EQ(rows.size(), 3u);
    EXPECT_TRUE(rows[1].starts_with("0,0.5,regular,0,1,0,")) << rows[1];
  }
}

TEST(CliFreeFormErrors, WeightsWithoutRatAreIgnoredWithAWord) {
  const WrongShape on("c.obj", "v 0 0 0 1\nv 1 0 0 5\ncstype bezier\ndeg 1\ncurv 0 1 1 2\nparm u 0 1\nend\n");
  EXPECT_TRUE(on.rows({"--grid", "3"}, true)[1].starts_with("0,0.5,regular,0.5,0,0,"));
  expect_parts(on.sampled({"--grid", "3"}).err, {"c.obj:5", "weight 5", "ignored", "rat"});
}

TEST(CliFreeFormErrors, PartsOfCurvesHaveTheirOwnEnds) {
  // y = x^2 on [0, 3] by a uniform quadratic: control points at means of knots, ordinates their products.
  const std::string points = "v -0.5 0 0\nv 0.5 0 0\nv 1.5 2 0\nv 2.5 6 0\nv 3.5 12 0\n",
                    body = "1 2 3 4 5\nparm u -2 -1 0 1 2 3 4 5\nend\n";
  const WrongShape on("c.obj", points + "cstype bspline\ndeg 2\ncurv 0.5 2.25 " + body);
  std::vector<std::string> rows = on.rows({"--grid", "2"});
  ASSERT_EQ(rows.size(), 6u);  // at knots second derivatives of a quadratic have sides
  EXPECT_TRUE(rows[0].starts_with("0,0,regular,0.5,0.25,0,")) << rows[0];
  EXPECT_TRUE(rows[1].starts_with("0,1,crease,1,1,0,")) << rows[1];
  EXPECT_TRUE(rows[5].starts_with("2,1,regular,2.25,5.0625,0,")) << rows[5];
  const std::string own = on.directory.write("own.csv", "curve,t\n0,0.5\n0,2\n0,2.25\n").string();
  rows = on.rows({"--at", own});
  EXPECT_TRUE(rows[1].starts_with("0,2,crease,2,4,0,")) << rows[1];
  const std::string outside = on.directory.write("outside.csv", "curve,t\n0,0.25\n").string();
  expect_failure(on.sampled({"--at", outside}), 3, {"outside.csv:2", "0.25", "0.5 to 2.25"});
}

TEST(CliFreeFormErrors, PartsOfSurfacesEndAtKnotsToo) {
  // x = u, y = v, cut at the knot u = 1: the piece beyond it is not meant.
  const WrongShape on("s.obj",
                      "v 0 0 0\nv 1 0 0\nv 2 0 0\nv 0 1 0\nv 1 1 0\nv 2 1 0\ncstype bspline\ndeg 1 1\n"
                      "surf 0 1 0 1 1 2 3 4 5 6\nparm u 0 0 1 2 2\nparm v 0 0 1 1\nend\n");
  const std::string own = on.directory.write("own.csv", "patch,u,v\n0,1,0.5\n0,0,1\n0,1,1\n").string();
  const std::vector<std::string> rows = on.rows({"--at", own});
  ASSERT_EQ(rows.size(), 3u);
  EXPECT_TRUE(rows[0].starts_with("0,1,0.5,") && rows[0].find(",1,0.5,0,") != std::string::npos) << rows[0];
  EXPECT_NE(rows[1].find(",0,1,0,"), std::string::npos) << rows[1];
  EXPECT_NE(rows[2].find(",1,1,0,"), std::string::npos) << rows[2];
  const std::string outside = on.directory.write("outside.csv", "patch,u,v\n0,1.5,0.5\n").string();
  expect_failure(on.sampled({"--at", outside}), 3, {"outside.csv:2", "outside the part"});
}

TEST(CliFreeFormErrors, PlacesOutsideAreNamedOrMovedToTheRim) {
  const WrongShape on("s.obj", biquadratic("bezier", "0 1", "0 1"));
  const std::string at = on.directory.write("at.csv", "face,u,v\n0,0.5,0.5\n0,1.5,-1\n").string();
  expect_failure(on.sampled({"--at", at}), 3, {"at.csv:3", "1.5"});
  EXPECT_TRUE(on.rows({"--at", at, "--clamp"})[1].starts_with("0,1,0,regular,2,0,0,"));
  const std::string face = on.directory.write("face.csv", "face,u,v\n1,0,0\n").string();
  expect_failure(on.sampled({"--at", face}), 3, {"face.csv:2", "face 1"});
}

// A knot of multiplicity p + 1: two pieces without a common end.
TEST(CliFreeFormErrors, KnotsThatJumpAreAccepted) {
  const WrongShape on("r.json", R"({"kind": "bspline_curve", "degree": 1, "knots": [0, 0, 1, 1, 2, 2],)"
                                R"("points": [[0, 0, 0], [1, 0, 0], [1, 5, 0], [2, 5, 0]]})");
  const std::string own = on.directory.write("own.csv", "curve,t,side\n0,1,-\n0,1,+\n0,1,\n").string();
  const std::vector<std::string> rows = on.rows({"--at", own});
  ASSERT_EQ(rows.size(), 3u);
  EXPECT_TRUE(rows[0].starts_with("0,1,-,crease,1,0,0,")) << rows[0];
  EXPECT_TRUE(rows[1].starts_with("0,1,+,crease,1,5,0,")) << rows[1];
  EXPECT_TRUE(rows[2].starts_with("0,1,,crease,1,5,0,")) << rows[2];
  const WrongShape surface("s.json", R"({"kind": "bspline_surface", "degree": [1, 1], "shape": [4, 2],)"
                                     R"("knots_u": [0, 0, 1, 1, 2, 2], "knots_v": [0, 0, 1, 1],)"
                                     R"("points": [[0, 0, 0], [1, 0, 0], [1, 0, 5], [2, 0, 5],)"
                                     R"([0, 1, 0], [1, 1, 0], [1, 1, 5], [2, 1, 5]]})");
  const std::vector<std::string> net = surface.rows({"--grid", "2"});
  ASSERT_EQ(net.size(), 8u);
  EXPECT_TRUE(net[1].starts_with("0,1,0,crease,1,0,0,")) << net[1];
  EXPECT_TRUE(net[4].starts_with("1,0,0,crease,1,0,5,")) << net[4];
}

TEST(CliFreeFormErrors, SpeedThatVanishesHasAPointAndNoNormal) {
  const WrongShape on("r.json", R"({"kind": "hermite_curve", "points": [[0, 0, 0], [1, 1, 0]],)"
                                R"("tangents": [[0, 0, 0], [0, 0, 0]]})");
  for (const std::string& row : {on.rows({"--grid", "3", "--derivatives", "1"})[0]})
    EXPECT_EQ(row, "0,0,undefined-normal,0,0,0,0,0,0,,,");
  // A corner whose two derivatives are parallel.
  const WrongShape folded("s.obj",
                          "v 0 0 0\nv 1 0 0\nv 2 0 0\nv 1 1 0\ncstype bezier\ndeg 1 1\nsurf 0 1 0 1 1 2 3 4\n"
                          "parm u 0 1\nparm v 0 1\nend\n");
  const std::vector<std::string> rows = folded.rows({"--grid", "2", "--derivatives", "1"});
  EXPECT_TRUE(rows[0].starts_with("0,0,0,undefined-normal,0,0,0,1,0,0,2,0,0,") && rows[0].ends_with(",,,")) << rows[0];
  EXPECT_TRUE(rows[3].starts_with("0,1,1,regular,")) << rows[3];
}

TEST(CliFreeFormErrors, KnotsOfOpenNurbsAreDoubledWithAWord) {
  const WrongShape obj("s.obj", biquadratic("bspline", "0 0 1 1", "0 0 1 1"));
  const WrongShape full("s.obj", biquadratic("bspline", "0 0 0 1 1 1", "0 0 0 1 1 1"));
  EXPECT_EQ(obj.rows({"--grid", "3"}, true), full.rows({"--grid", "3"}));
  expect_parts(obj.sampled({"--grid", "3"}).err,
               {"s.obj:13", "4 knots for 3 control points", "without the first and the last", "doubled", "s.obj:14"});
  const WrongShape json("r.json", altered_recipe("cone", "[0, 0, 0, 1, 1, 1]", "[0, 0, 1, 1]"));
  expect_parts(json.sampled({"--grid", "3"}).err, {"recipe 0 (cone): knots: the first and the last are left out"});
}

TEST(CliFreeFormErrors, TrimsAreKeptAndToldOnce) {
  const WrongShape on("s.obj", "vp 0 0\nvp 1 0\nvp 1 1\n" + nine_vertices +
                                   "cstype bezier\ndeg 1 1\ncurv2 1 2 3 1\nparm u 0 1 2 3\nend\n"
                                   "surf 0 1 0 1 1 2 4 5\nparm u 0 1\nparm v 0 1\ntrim 0 3 1\nend\n"
                                   "surf 0 1 0 1 2 3 5 6\nparm u 0 1\nparm v 0 1\nhole 0 3 1\nend\n");
  const Outcome outcome = on.sampled({"--grid", "3"});
  EXPECT_EQ(outcome.status, 0);
  EXPECT_EQ(count_of(outcome.err, "2 of 2 surfaces have trimming loops; they are taken untrimmed"), 1u) << outcome.err;
  EXPECT_EQ(count_of(outcome.err, "\n"), 1u) << outcome.err;
  EXPECT_EQ(on.rows({"--grid", "3", "--quiet"}).size(), 18u);
  expect_parts(expect_done(sublimit({"info", on.shape})).out, {"1 trims, 0 holes", "0 trims, 1 holes", "untrimmed"});
}

TEST(CliFreeFormErrors, LevelsBeyondMemoryAreRefusedAtOnce) {
  const WrongShape on("s.obj", biquadratic("bezier", "0 1", "0 1"));
  const auto expect_told = [&](const std::vector<std::string>& command, std::initializer_list<std::string_view> parts) {
    SCOPED_TRACE(command[0]);
    const Outcome outcome = sublimit(command);
    expect_failure(outcome, 4, parts);
    EXPECT_LT(outcome.peak_kb, 200 << 10);
    EXPECT_EQ(on.directory.num_files(), 1);
  };
  expect_told({"refine", on.shape, "-l", "20", "-o", on.path("o.obj")}, {"20 levels of 1 faces", "use at most 1"});
  expect_told({"refine", on.shape, "-l", "20", "-o", on.path("o.obj"), "--matrix", on.path("o.mtx")},
              {"20 levels of 1 faces", "use at most 1"});
  expect_told({"limit", on.shape, "-l", "20", "-o", on.path("o.ply")}, {"20 levels of 1 faces", "use at most 1"});
  expect_told({"bake", on.shape, "-l", "6", "--mem-limit", "1M", "-o", on.path("o.safetensors")},
              {"6 levels of 1 faces", "the limit is 1.0 MB", "use at most"});
  expect_failure(sublimit({"refine", on.shape, "-l", "21", "-o", on.path("o.obj")}), 2, {"1 to 20 levels"});
}

TEST(CliFreeFormErrors, SurfacesBeyondMemoryAreRefusedBeforeItIsTaken) {
  // The same three points over and over: a surface of 300 x 300.
  std::string text = "v 0 0 0\nv 1 0 0\nv 0 1 0\ncstype bspline\ndeg 1 1\nsurf 0 1 0 1", knots = "0";
  for (int i = 0; i < 90000; ++i) text += i % 3 == 0 ? " 1" : i % 3 == 1 ? " 2" : " 3";
  for (int i = 0; i < 300; ++i) knots += " " + std::to_string(i);
  knots += " 299";
  const WrongShape on("s.obj", text + "\nparm u " + knots + "\nparm v " + knots + "\nend\n");
  expect_failure(on.sampled({"--random", "5", "--mem-limit", "100K"}), 4,
                 {"s.obj", "of text take about", "the limit is 100.0 KB"});
  expect_failure(on.sampled({"--random", "5", "--mem-limit", "1M"}), 4,
                 {"s.obj", "of curves and surfaces take about", "the limit is 1.0 MB"});
  expect_failure(on.sampled({"--random", "5", "--mem-limit", "2M"}), 4,
                 {"s.obj: surfaces of 90000 control points take about 3.2 MB", "the limit is 2.0 MB"});
  EXPECT_EQ(on.directory.num_files(), 1);
  EXPECT_EQ(on.rows({"--random", "5", "--mem-limit", "20M"}).size(), 5u);
  // A file larger than any memory, most of it a hole.
  const WrongShape huge("h.obj", "v 0 0 0\n");
  std::filesystem::resize_file(huge.shape, std::uintmax_t{1} << 43);
  const Outcome outcome = huge.sampled({"--grid", "3"});
  expect_failure(outcome, 4, {"h.obj: 8.7 TB of text take about", "this machine has"});
  EXPECT_LT(outcome.peak_kb, 200 << 10);
}

/// y = |t - k| up and down at every knot k: a million of them.
TEST(CliFreeFormErrors, AMillionKnotsAreNoTrouble) {
  constexpr int count = 1000000;
  std::string points, knots = "0";
  for (int i = 0; i < count; ++i) points += i % 2 == 0 ? " 1" : " 2";
  for (int i = 0; i < count; ++i) knots += " " + std::to_string(i);
  knots += " " + std::to_string(count - 1);
  const std::string vertices = "v 0 0 0\nv 0 1 0\n", range = "0 " + std::to_string(count - 1);
  {
    const WrongShape on("c.obj",
                        vertices + "cstype bspline\ndeg 1\ncurv " + range + points + "\nparm u " + knots + "\nend\n");
    expect_parts(expect_done(sublimit({"info", on.shape})).out, {"C^0 at 1 2 3", "more"});
    const std::string own = on.directory.write("own.csv", "curve,t\n0,999998.25\n0,3.5\n").string();
    const std::vector<std::string> rows = on.rows({"--at", own});
    ASSERT_EQ(rows.size(), 2u);
    EXPECT_TRUE(rows[0].starts_with("0,999998.25,regular,0,0.25,0,")) << rows[0];
    EXPECT_TRUE(rows[1].starts_with("0,3.5,regular,0,0.5,0,")) << rows[1];
  }
  // A part of a surface that has as many faces along u.
  const WrongShape on(
      "s.obj", vertices + "v 0 0 1\nv 0 1 1\ncstype bspline\ndeg 1 1\nsurf 0.5 999998.5 0 1" + points +
                   [&] {
                     std::string upper;
                     for (int i = 0; i < count; ++i) upper += i % 2 == 0 ? " 3" : " 4";
                     return upper;
                   }() +
                   "\nparm u " + knots + "\nparm v 0 0 1 1\nend\n");
  std::string places = "patch,u,v\n";
  for (int i = 0; i < 1000; ++i) places += "0," + format_number(i * 998 + 0.75) + ",0.5\n";
  const std::string own = on.directory.write("own.csv", places).string();
  const std::vector<std::string> rows = on.rows({"--at", own});
  ASSERT_EQ(rows.size(), 1000u);
  EXPECT_NE(rows[999].find("regular,0,0.75,0.5,"), std::string::npos) << rows[999];
}

}  // namespace
}  // namespace sublimit::testing
