// SPDX-License-Identifier: Apache-2.0
// `sublimit analyze RECIPE.json`: joins that recipes ask for, decided in their fractions; and all other kinds as the
// free-form file that `construct` writes.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "stencils/cli_program.h"
#include "stencils/markup.h"
#include "stencils/recipes/recipe_samples.h"

namespace sublimit::testing {
namespace {

using RecipeJson = nlohmann::ordered_json;

class AnalyzedRecipe {
 public:
  explicit AnalyzedRecipe(const std::string& text) { directory.write("r.json", text); }
  std::string path(std::string_view name) const { return (directory / name).string(); }
  Outcome analyzed(std::vector<std::string> more = {}, const char* file = "r.json") const {
    more.insert(more.begin(), {"analyze", path(file)});
    return sublimit(more);
  }
  /// The FREE-FORM object.
  RecipeJson report(int status = 0, std::vector<std::string> more = {}, const char* file = "r.json") const {
    more.insert(more.end(), {"--json", path("report.json"), "--quiet"});
    const Outcome outcome = analyzed(more, file);
    EXPECT_EQ(outcome.status, status) << outcome.err;
    return RecipeJson::parse(read_file(path("report.json")))["free_form"];
  }
  RecipeJson joint() const { return report()["joints"]["list"][0]; }
  RecipeJson seam() const { return report()["seams"]["list"][0]; }

  TemporaryDirectory directory;
};

/// Along a line: from 0 to `middle` in a unit of the parameter, to `end` in two.
std::string line_join(const std::string& middle, const std::string& end) {
  return R"({"kind": "curve_join", "name": "line", "left": {"points": [[0, 0], [)" + middle +
         R"(, 0]]}, "right": {"points": [[)" + middle + ", 0], [" + end + R"(, 0]], "length": 2}})";
}

/// Two unit squares that meet at x = 1, the right one turned up and moved.
std::string square_join(const std::string& up, const std::string& moved = "1", const std::string& length = "1") {
  return R"({"kind": "surface_join", "left": {"degree": [1, 1], "points": [[0, 0], [1, 0], [0, 1], [1, 1]]}, "right": {"degree": [1, 1], "points": [[)" +
         moved + ", 0, 0], [2, 0, " + up + "], [" + moved + ", 1, 0], [2, 1, " + up + R"(]], "length": )" + length +
         "}}";
}

TEST(CliAnalyzeRecipes, FractionsDecideJoinsOfCurves) {
  // Speeds 1/10 and (3/10 - 1/10)/2: the same as fractions, not as the doubles nearest to them.
  const RecipeJson fractions = AnalyzedRecipe(line_join(R"("1/10")", R"("3/10")")).joint(),
                   doubles = AnalyzedRecipe(line_join("0.1", "0.3")).joint();
  EXPECT_EQ(fractions["exact"]["same"], true);
  EXPECT_EQ(doubles["exact"]["same"], false);
  EXPECT_EQ(doubles["exact"]["c"], 0);
  EXPECT_GE(doubles["exact"]["g"], 2);
  for (const RecipeJson& joint : {fractions, doubles}) {
    EXPECT_EQ(joint["measured"]["same"], true) << "up to rounding";
    EXPECT_EQ(joint["recipe"], "recipe 0 'line' (curve_join)");
    EXPECT_EQ(joint["curves"], (RecipeJson{0, 1}));
    EXPECT_EQ(joint["parameters"], (RecipeJson{1.0, 0.0}));
    EXPECT_EQ(joint["at"][0], 0.1);
  }
  expect_parts(expect_done(AnalyzedRecipe(line_join(R"("1/10")", R"("3/10")")).analyzed()).out,
               {"0 surfaces, 2 curves", "joints: C^infinity, G^infinity at its only joint",
                "recipe 0 'line' (curve_join): C^infinity, G^infinity exactly, measured C^infinity, G^infinity"});
  // Half a circle in two quarters: one rational map where both have a unit of the parameter.
  const auto circle = [](const std::string& length) {
    return AnalyzedRecipe(R"({"kind": "curve_join", "left": {"homogeneous": [[2, 0, 2], [1, 1, 1], [0, 1, 1]]},)"
                          R"("right": {"homogeneous": [[0, 1, 1], [-1, 1, 1], [-2, 0, 2]], "length": )" +
                          length + "}}")
        .joint();
  };
  EXPECT_EQ(circle("1")["exact"]["same"], true);
  EXPECT_EQ(circle("1")["measured"]["same"], true);
  EXPECT_EQ(circle("\"1/3\"")["exact"]["c"], 0);
  EXPECT_GE(circle("\"1/3\"")["exact"]["g"].get<int>(), 2);
  EXPECT_EQ(circle("\"1/3\"")["ratios"][0], 3);
}

TEST(CliAnalyzeRecipes, JoinsOfSurfaces) {
  const RecipeJson flat = AnalyzedRecipe(square_join("0")).seam(),
                   longer = AnalyzedRecipe(square_join("0", "1", "2")).seam();
  EXPECT_EQ(flat["exact"]["same"], true);
  EXPECT_EQ(flat["exact"]["g"], 2);
  EXPECT_EQ(flat["recipe"], "recipe 0 (surface_join)");
  EXPECT_EQ(flat["lines"], RecipeJson::parse(R"([{"patch":0,"u":1.0},{"patch":1,"u":0.0}])"));
  EXPECT_EQ(longer["exact"]["c"], 0);
  EXPECT_EQ(longer["exact"]["g"], 2);
  // An angle whose tangent is 1/8: 7.125 degrees.
  const AnalyzedRecipe kink(square_join(R"("1/8")"));
  const RecipeJson seam = kink.seam();
  EXPECT_EQ(seam["exact"],
            RecipeJson::parse(R"json({"c":0,"g":0,"same":false,"obstacle":"angle","says":"C^0, G^0 (angle)"})json"));
  EXPECT_EQ(seam["measured"]["g"], 0);
  constexpr double in_degrees = 1e-12;  // an angle near 7, from a quotient
  EXPECT_NEAR(seam["g1_degrees"]["value"].get<double>(), 7.125016348901798, in_degrees);
  expect_parts(expect_done(kink.analyzed()).out,
               {"seams: G^0 at its only seam: largest angle 7.125 degrees between patch 0 and patch 1",
                "recipe 0 (surface_join): C^0, G^0 (angle) exactly, measured C^0, G^0 (angle)"});
  expect_done(kink.analyzed({"--tolerance", "g1=7.2deg"}));
  const Outcome beyond = kink.analyzed({"--tolerance", "g1=7deg"});
  EXPECT_EQ(beyond.status, 1);
  expect_parts(beyond.out, {"beyond the tolerance: g1 7.13", "seam 0"});
}

TEST(CliAnalyzeRecipes, JoinsThatDoNotMeetAreAGap) {
  const AnalyzedRecipe surfaces(square_join("0", R"("3/2")")), curves(line_join("1", "2"));
  EXPECT_EQ(surfaces.seam()["exact"]["g"], -1);
  EXPECT_EQ(surfaces.seam()["g0"]["value"], 0.5);
  expect_parts(expect_done(surfaces.analyzed()).out, {"a gap exactly, measured a gap"});
  EXPECT_EQ(surfaces.analyzed({"--tolerance", "g0=0.4"}).status, 1);
  EXPECT_EQ(surfaces.analyzed({"--tolerance", "g0=0.6"}).status, 0);
  EXPECT_EQ(curves.joint()["g0"], 0);
}

TEST(CliAnalyzeRecipes, JoinsStandBesideOtherShapes) {
  // The flat join lies on a bilinear patch of the file: it is judged on its own all the same.
  const AnalyzedRecipe file(R"({"recipes": [)" + square_join("0") + ", " + line_join("1", "3") + ", " +
                            sample_recipe("bezier_surface", R"("name": "saddle", )") + ", " + line_join("1", "4") +
                            ", " + sample_recipe("bezier_curve") + "]}");
  const RecipeJson report = file.report();
  EXPECT_EQ(report["counts"]["surfaces"], 3);
  EXPECT_EQ(report["counts"]["curves"], 5);
  std::vector<std::string> of;
  for (const RecipeJson& patch : report["patches"]) of.push_back(patch["recipe"]);
  EXPECT_EQ(of, (std::vector<std::string>{"recipe 2 'saddle' (bezier_surface)", "recipe 0 (surface_join)",
                                          "recipe 0 (surface_join)"}));
  EXPECT_EQ(report["patches"][0]["line"], nullptr);
  EXPECT_EQ(report["seams"]["kinds"]["boundary"], 4) << "of the patch that is no join";
  EXPECT_EQ(report["seams"]["kinds"]["sides"], 1);
  EXPECT_EQ(report["joints"]["list"].size(), 2u);
  EXPECT_EQ(report["joints"]["free_ends"], 6) << "two of the curve, and two of each join";
  // From 0 to 1 in a unit of the parameter, then on to 3 or to 4 in two: one line, with two speeds in the second case.
  std::map<std::string, int> c;
  for (const RecipeJson& joint : report["joints"]["list"]) c[joint["recipe"]] = joint["exact"]["c"];
  EXPECT_EQ(c["recipe 3 'line' (curve_join)"], 0);
  EXPECT_GE(c["recipe 1 'line' (curve_join)"], 1);
}

TEST(CliAnalyzeRecipes, JoinsOfOpenArcsHaveTwoFreeEnds) {
  const std::string arcs[] = {R"("points": [[0, 0], [1, 1], [2, 0]])", R"("points": [[2, 0], [3, -1], [4, 0]])"};
  const AnalyzedRecipe join(R"({"kind": "curve_join", "left": {)" + arcs[0] + R"(}, "right": {)" + arcs[1] + "}}");
  const AnalyzedRecipe apart(R"({"recipes": [{"kind": "bezier_curve", "degree": 2, )" + arcs[0] +
                             R"(}, {"kind": "bezier_curve", "degree": 2, )" + arcs[1] + "}]}");
  const AnalyzedRecipe closed(
      R"({"kind": "curve_join", "left": {"points": [[0, 0], [1, 1], [2, 0]]}, "right": {"points": [[2, 0], [1, -1], [0, 0]]}})");
  EXPECT_EQ(join.report()["joints"]["free_ends"], 2);
  EXPECT_EQ(apart.report()["joints"]["free_ends"], 2);
  EXPECT_EQ(closed.report()["joints"]["free_ends"], 0);
}

TEST(CliAnalyzeRecipes, ClosedNetsAreDecidedAsTheyAre) {
  // A ring of three points along u, straight along v: C^1 where degree 2 closes.
  const RecipeJson ring =
      AnalyzedRecipe(R"({"kind": "bspline_surface", "degree": [2, 1], "closed": [true, false], "shape": [3, 2],)"
                     R"("knots_u": [0, "1/3", "2/3", 1], "knots_v": [0, 0, 1, 1],)"
                     R"("points": [[0, 0, 0], [3, 0, 0], [0, 3, 0], [0, 0, 1], [3, 0, 1], [0, 3, 1]]})")
          .report();
  EXPECT_EQ(ring["patches"][0]["converted"], false);
  int closing = 0;
  for (const RecipeJson& seam : ring["seams"]["list"]) {
    if (seam["kind"] != "sides") continue;
    ++closing;
    EXPECT_EQ(seam["exact"]["c"], 1) << seam;
  }
  EXPECT_EQ(closing, 1);
}

/// Two Hermite curves with thirds in their control points, the tangents in the middle being (1, 0) and `right`.
std::string hermite_curves(const std::string& right) {
  return R"({"recipes": [{"kind": "hermite_curve", "points": [[0, 0], [1, 1]], "tangents": [[0, 2], [1, 0]]},)"
         R"({"kind": "hermite_curve", "points": [[1, 1], [2, 0]], "tangents": [)" +
         right + R"(, [0, -5]]}]})";
}

TEST(CliAnalyzeRecipes, DataInWholeNumbersAreDecidedWithoutRounding) {
  const auto exact = [](const std::string& text) { return AnalyzedRecipe(text).joint()["exact"]; };
  EXPECT_EQ(exact(hermite_curves("[1, 0]"))["c"], 1);
  EXPECT_EQ(exact(hermite_curves("[3, 0]"))["says"], "C^0, G^1 (curvature)");
  EXPECT_EQ(exact(hermite_curves(R"([1, "1/1000000000000"])"))["says"], "C^0, G^0 (angle)");
  EXPECT_EQ(exact(hermite_curves(R"(["1/3", 0])"))["g"], 1);
  // (1 + t)^3/3 in two pieces, by powers; and by Hermite data.
  EXPECT_EQ(exact(R"({"recipes": [{"kind": "taylor_curve", "points": [["1/3", 0], [1, 1], [1, 0], ["1/3", 0]]},)"
                  R"({"kind": "taylor_curve", "points": [["8/3", 1], [4, 1], [2, 0], ["1/3", 0]]}]})")["says"],
            "C^infinity, G^infinity");
  // A uniform cubic of two segments, by its basis matrix in either form.
  const std::string points = R"("points": [[0, 0], [1, 2], [2, -1], [3, 0], [4, 1]])";
  const std::string
      obj =
          R"([["1/6", "-1/2", "1/2", "-1/6"], ["2/3", 0, -1, "1/2"], ["1/6", "1/2", "1/2", "-1/2"], [0, 0, 0, "1/6"]])",
      textbook =
          R"([["-1/6", "1/2", "-1/2", "1/6"], ["1/2", -1, "1/2", 0], ["-1/2", 0, "1/2", 0], ["1/6", "2/3", "1/6", 0]])";
  const auto matrix = [&](const std::string& m, const std::string& more) {
    return R"({"kind": "bmatrix_curve", "degree": 3, "step": 1, "matrix": )" + m + ", " + points + more + "}";
  };
  EXPECT_EQ(exact(matrix(obj, ""))["says"], "C^2, G^2 (curvature)");
  EXPECT_EQ(exact(matrix(textbook, R"(, "form": "textbook")"))["says"], "C^2, G^2 (curvature)");
  // The other form by mistake is found by the sums of its functions.
  expect_failure(AnalyzedRecipe(matrix(textbook, "")).analyzed(), 3,
                 {"matrix: is M of (t^n .. t 1) M P", "row for each control point", "\"form\": \"textbook\""});
  // What is solved for or irrational is measured alone.
  for (const char* kind : {"interpolate_cubic", "revolution"}) {
    const RecipeJson found = AnalyzedRecipe(sample_recipe(kind)).report();
    for (const char* part : {"seams", "joints"})
      for (const RecipeJson& one : found[part]["list"])
        EXPECT_TRUE(!one.contains("exact") || one["exact"].is_null()) << kind << one;
  }
}

TEST(CliAnalyzeRecipes, SurfacesOfWholeNumbersAreDecidedWithoutRounding) {
  // Bicubic Hermite patches side by side, corners at 0, 1 and 2; all derivatives at the common side are the same.
  const auto patch = [](int from, const std::string& bend) {
    const std::string a = std::to_string(from), b = std::to_string(from + 1);
    const std::string left = from == 0 ? "[1, 0, 2]" : "[1, 0, 1]",
                      right = from == 0 ? "[1, 0, 1]" : "[1, 0, " + bend + "]";
    return R"({"kind": "hermite_surface", "vectors": "12", "p": [[)" + a + ", 0, " + a + "], [" + b + ", 0, " + b +
           "], [" + a + ", 1, " + a + "], [" + b + ", 1, " + b + R"(]], "pu": [)" + left + ", " + right + ", " + left +
           ", " + right + R"(], "pv": [[0, 1, 0], [0, 1, 0], [0, 1, 0], [0, 1, 0]]})";
  };
  const AnalyzedRecipe hermite(R"({"recipes": [)" + patch(0, "1") + ", " + patch(1, "5") + "]}");
  const auto side = [](const RecipeJson& report) {
    for (const RecipeJson& seam : report["seams"]["list"])
      if (seam["kind"] == "sides") return seam;
    return RecipeJson();
  };
  const RecipeJson joined = side(hermite.report());
  EXPECT_EQ(joined["exact"]["c"], 1) << joined;
  EXPECT_EQ(joined["exact"]["g"], 1);
  // Bicubic Coons patches over curves that are C^1: so are they, by thirds.
  const auto coons = [](const std::string& x0, const std::string& x1, const std::string& z0, const std::string& z1) {
    const auto curve = [](const std::string& a, const std::string& b) {
      return R"({"degree": 1, "knots": [0, 0, 1, 1], "points": [)" + a + ", " + b + "]}";
    };
    const std::string p00 = "[" + x0 + ", 0, " + z0 + "]", p10 = "[" + x1 + ", 0, " + z1 + "]",
                      p01 = "[" + x0 + ", 1, " + z0 + "]", p11 = "[" + x1 + ", 1, " + z1 + "]";
    return R"({"kind": "coons_bicubic", "c0": )" + curve(p00, p10) + R"(, "c1": )" + curve(p01, p11) + R"(, "d0": )" +
           curve(p00, p01) + R"(, "d1": )" + curve(p10, p11) + "}";
  };
  const RecipeJson flat =
      side(AnalyzedRecipe(R"({"recipes": [)" + coons("0", "1", "0", "1") + ", " + coons("1", "2", "1", "2") + "]}")
               .report());
  EXPECT_GE(flat["exact"]["g"].get<int>(), 1) << flat;
  const RecipeJson bent =
      side(AnalyzedRecipe(R"({"recipes": [)" + coons("0", "1", "0", "1") + ", " + coons("1", "2", "1", "1") + "]}")
               .report());
  EXPECT_EQ(bent["exact"]["g"], 0) << bent;
}

TEST(CliAnalyzeRecipes, AreAnalyzedAsTheFileThatConstructWrites) {
  std::string all;
  std::vector<std::string> kinds;
  for (const auto& [kind, fields] : sample_fields()) {
    const AnalyzedRecipe one(sample_recipe(kind));
    if (sublimit({"construct", one.path("r.json"), "-o", one.path("n.obj"), "--quiet"}).status != 0) continue;
    all += (all.empty() ? "" : ", ") + sample_recipe(kind);
    kinds.push_back(kind);
  }
  EXPECT_GE(kinds.size(), 25u);
  const AnalyzedRecipe file(R"({"recipes": [)" + all + "]}");
  expect_done(sublimit({"construct", file.path("r.json"), "-o", file.path("r.obj"), "--quiet"}));
  RecipeJson recipes = file.report(), shapes = file.report(0, {}, "r.obj");
  EXPECT_GT(recipes["seams"]["list"].size(), 20u);
  for (RecipeJson* const report : {&recipes, &shapes}) {
    report->erase("file");
    // Exact verdicts are about the numbers of the recipe, or of the file.
    for (const char* part : {"seams", "joints"})
      for (RecipeJson& one : (*report)[part]["list"]) one.erase("exact");
    for (const char* list : {"patches", "curves"})
      for (RecipeJson& element : (*report)[list])
        element.erase("line"), element.erase("recipe"), element.erase("converted");
    RecipeJson others = RecipeJson::array();
    for (RecipeJson& warning : (*report)["warnings"]) {
      warning.erase("where");
      if (warning["says"].get<std::string>().find("not decided exactly") == std::string::npos)
        others.push_back(warning);
    }
    (*report)["warnings"] = std::move(others);
  }
  EXPECT_EQ(recipes, shapes);
}

TEST(CliAnalyzeRecipes, SayWhatHasNoNet) {
  const AnalyzedRecipe file(R"({"recipes": [)" + sample_recipe("screw") + ", " + sample_recipe("cone") + ", " +
                            sample_recipe("nielson", R"("name": "tip", )") + ", " + sample_recipe("implicit") + "]}");
  const Outcome outcome = expect_done(file.analyzed());
  expect_parts(
      outcome.out,
      {"1 surfaces, 0 curves",
       "warning: rows and no exact net, so that its joins are not looked for: ", "recipe 0 (screw)",
       "warning: no exact net, so that its joins are not looked for: ", "recipe 2 'tip' (nielson) and 1 more"});
  for (const char* kind : {"screw", "bezier_triangle", "nielson", "implicit"})
    expect_failure(
        AnalyzedRecipe(sample_recipe(kind)).analyzed(), 3,
        {"r.json: recipe 0 (" + std::string(kind) + "): no exact net, so that there are no joins to analyse"});
}

TEST(CliAnalyzeRecipes, PageAndPictureAreWellFormed) {
  const AnalyzedRecipe file(R"({"recipes": [)" + square_join("0.5") + ", " + line_join("1", "3") + ", " +
                            sample_recipe("revolution", R"("name": "a < b", )") + ", " + sample_recipe("screw") + "]}");
  const std::string page = file.path("page.html"), picture = file.path("picture.svg");
  EXPECT_EQ(file.analyzed({"-o", page, "--picture", picture, "--json", file.path("report.json")}).status, 0);
  const std::string text = read_file(page);
  const Markup markup = read_markup(text);
  EXPECT_EQ(markup.fault, "");
  expect_parts(text, {R"("file":"r.json")", "recipe 2 'a \\u003c b' (revolution)", R"("curves":[{)"});
  EXPECT_EQ(read_markup(read_file(picture)).fault, "");
  expect_done(sublimit({"verify", file.path("report.json")}));
}

TEST(CliAnalyzeRecipes, RefuseWhatTheyCannotUse) {
  const AnalyzedRecipe file(square_join("0"));
  expect_failure(file.analyzed({"--tolerance", "g3=1"}), 2, {"g3=1"});
  expect_failure(file.analyzed({"--valence", "3-5"}), 2, {"--valence is for schemes", "free-form shapes"});
  expect_failure(file.analyzed({"--json", file.path("r.json")}), 2, {"r.json", "this file is MESH, which is read"});
  expect_failure(file.analyzed({}, "none.json"), 3, {"none.json"});
  expect_failure(AnalyzedRecipe("{").analyzed(), 3, {"r.json:1"});
  expect_failure(AnalyzedRecipe(square_join("0", "1", "0")).analyzed(), 3,
                 {"recipe 0 (surface_join): right.length", "more than 0"});
  std::string points;
  for (int i = 0; i <= 70; ++i) points += (i > 0 ? ", [" : "[") + std::to_string(i) + ", 0]";
  expect_failure(AnalyzedRecipe(R"({"kind": "curve_join", "left": {"points": [)" + points +
                                R"(]}, "right": {"points": [[70, 0], [71, 0]]}})")
                     .analyzed(),
                 3, {"r.json: recipe 0 (curve_join): "});
}

}  // namespace
}  // namespace sublimit::testing
