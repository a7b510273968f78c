// SPDX-License-Identifier: Apache-2.0
// Recipes of every kind are read; what is wrong is named by file, recipe and field.
#include "sublimit/stencils/recipes/detail/recipe.h"

#include <gtest/gtest.h>

#include <cmath>

#include "meshes/construction_data.h"
#include "stencils/recipes/recipe_samples.h"
#include "sublimit/stencils/recipes/detail/net_file.h"
#include "sublimit/stencils/recipes/detail/recipe_sources.h"
#include "support/expect_error.h"

namespace sublimit::testing {
namespace {

std::vector<Recipe> parse(const std::string& text) { return parse_recipes(text, "r.json"); }

TEST(Recipes, EveryKindHasASampleAndIsRead) {
  std::vector<std::string> kinds;
  for (const auto& [kind, fields] : sample_fields()) kinds.push_back(kind);
  EXPECT_EQ(recipe_kinds().size(), kinds.size());
  for (const std::string& kind : recipe_kinds()) {
    SCOPED_TRACE(kind);
    ASSERT_NE(std::ranges::find(kinds, kind), kinds.end());
    const Recipe recipe = parse(sample_recipe(kind, R"("name": "a", "group": "g", )"))[0];
    EXPECT_EQ(recipe.kind, kind);
    EXPECT_EQ(recipe.name, "a");
    EXPECT_EQ(recipe.group, "g");
    EXPECT_EQ(recipe.place, "r.json: recipe 0 'a' (" + kind + ")");
    if (const RecipeSurface* const surface = recipe.surface()) {
      EXPECT_EQ(surface->columns.rows(), surface->patch->num_points());
      EXPECT_TRUE(surface->columns.allFinite());
      EXPECT_EQ(surface->net.has_value(), surface->no_net.empty() || kind == "lagrange_surface");
    } else if (const RecipeCurve* const curve = recipe.curve()) {
      EXPECT_EQ(curve->columns.rows(), curve->curve->num_points());
      EXPECT_TRUE(curve->net.has_value());
    }
  }
}

TEST(Recipes, NormalsOfAMeshAreGivenOrEstimated) {
  EXPECT_FALSE(parse(sample_recipe("piper"))[0].normal_triangles()->estimated);
  EXPECT_FALSE(parse(sample_recipe("piper", R"("normals": "given", )"))[0].normal_triangles()->estimated);
  EXPECT_TRUE(parse(sample_recipe("piper", R"("normals": "estimated", )"))[0].normal_triangles()->estimated);
}

TEST(Recipes, NetsOfThoseThatHaveOne) {
  const std::vector<Recipe> all =
      parse(R"({"recipes": [)" + sample_recipe("screw") + ", " + sample_recipe("cone") + ", " +
            sample_recipe("curve_join", R"("name": "a", )") + ", " + sample_recipe("nurbs_curve") + "]}");
  const RecipeNets nets = recipe_nets(all);
  EXPECT_EQ(nets.surface, std::vector<const Recipe*>{&all[1]});
  EXPECT_EQ(nets.curve, std::vector<const Recipe*>{&all[3]});
  ASSERT_EQ(nets.left_out.size(), 2u);
  EXPECT_EQ(label(*nets.left_out[0].recipe), "recipe 0 (screw)");
  EXPECT_EQ(label(*nets.left_out[1].recipe), "recipe 2 'a' (curve_join)");
  EXPECT_EQ(nets.shapes.surfaces.size(), 1u);
  EXPECT_EQ(nets.shapes.curves.size(), 1u);
}

TEST(Recipes, NetsAreThePatches) {
  for (const auto& [kind, fields] : sample_fields()) {
    SCOPED_TRACE(kind);
    const Recipe recipe = parse(sample_recipe(kind))[0];
    const RecipeSurface* const surface = recipe.surface();
    if (!surface || !surface->net) continue;
    const SplineNet& net = *surface->net;
    const Patch::Parameters at = surface->patch->parameters({0, 0.3, 0.6});
    expect_near(own_values(net, at.u, at.v).x,
                own_values(*surface->patch, surface->columns, surface->coordinates, at.u, at.v).x, derivative_sums);
  }
}

TEST(Recipes, SeveralInOneFile) {
  const std::vector<Recipe> all =
      parse(R"({"recipes": [)" + sample_recipe("ruled") + ", " + sample_recipe("nurbs_curve") + ", " +
            sample_recipe("revolution") + ", " + sample_recipe("interpolate_cubic") + "]}");
  ASSERT_EQ(all.size(), 4u);
  EXPECT_EQ(all[2].index, 2u);
  const RecipePatches surfaces = recipe_patches(all, "r.json");
  EXPECT_EQ(surfaces.patches.members().size(), 2u);
  EXPECT_EQ(surfaces.patches.coordinates(), Coordinates::homogeneous);
  EXPECT_EQ(surfaces.columns.rows(), surfaces.patches.num_points());
  EXPECT_EQ(surfaces.columns.col(3).head(6), Eigen::VectorXd::Ones(6));
  const RecipeCurves curves = recipe_curves(all, "r.json");
  EXPECT_EQ(curves.curves.num_curves(), 2);
  EXPECT_EQ(curves.curves.num_segments(), 3);
  EXPECT_EQ(curves.columns.cols(), 4);  // of the plane and of space, one of them rational
  const std::vector<CurvePlace> places{{0, 0.5}, {2, 1}};
  const CurveSamples at = curves.curves.evaluate(curves.columns, places, 2, curves.coordinates);
  EXPECT_NEAR(at.position.row(0).norm(), 1, sums);  // a quarter of the unit circle
  expect_near(at.position.row(1), Eigen::RowVector3d(2, 0, 1), sums);
}

TEST(Recipes, TrianglesAndSquaresAreRefusedTogether) {
  const std::vector<Recipe> both =
      parse(R"({"recipes": [)" + sample_recipe("ruled") + ", " + sample_recipe("bezier_triangle") + "]}");
  expect_error<UnsupportedTopology>([&] { recipe_patches(both, "r.json"); }, {"r.json", "triangles", "squares"});
  expect_error<UnsupportedTopology>([&] { recipe_curves(both, "r.json"); }, {"r.json: 2 recipes, none of a curve"});
}

TEST(Recipes, FractionsAreExact) {
  const Recipe recipe = parse(sample_recipe("curve_join"))[0];
  const auto& join = std::get<JoinRecipe>(recipe.shape);
  const ExactNumber& third = join.left.points[1][1];
  EXPECT_EQ(third.value, 1.0 / 3);
  EXPECT_EQ(third.text, "1/3");
  EXPECT_EQ(third.numerator, 1);
  EXPECT_EQ(third.denominator, 3);
  EXPECT_EQ(join.right.points[1][1].text, "0.1");
  EXPECT_EQ(join.right.points[1][1].denominator, 0);
  EXPECT_EQ(join.right.length.text, "2/3");
  EXPECT_EQ(join.left.degree, std::vector<int>{1});
}

TEST(ExactNumbers, AreTheNearestDoubles) {
  EXPECT_EQ(nearest_double(1, 3), 1.0 / 3);
  EXPECT_EQ(nearest_double(-7, 11), -7.0 / 11);
  EXPECT_EQ(nearest_double(0, 5), 0);
  std::mt19937_64 random(1);
  for (int repeat = 0; repeat < 2000; ++repeat) {
    const auto p = std::int64_t(random()) >> (random() % 63), q = std::int64_t((random() >> 1) >> (random() % 62)) | 1;
    const Precise exact = Precise(p) / Precise(q);
    EXPECT_EQ(nearest_double(p, q), exact.convert_to<double>()) << p << "/" << q;
  }
  EXPECT_EQ(nearest_double(std::numeric_limits<std::int64_t>::min(), 1), -0x1p63);
  for (const char* text : {"", "/", "1/", "/2", "1/0", "1/-2", "a", "1.5", "1/2/3", "99999999999999999999", " 1/2"})
    EXPECT_FALSE(parse_fraction(text)) << text;
  EXPECT_EQ(parse_fraction("-3")->value, -3);
}

TEST(Recipes, NotesSayWhatWasAccepted) {
  const Recipe short_knots = parse(sample_recipe("bspline_surface"))[0];
  ASSERT_EQ(short_knots.notes.size(), 2u);
  EXPECT_NE(short_knots.notes[0].find("openNURBS"), std::string::npos);
  const Recipe negative = parse(
      R"({"kind": "nurbs_curve", "degree": 1, "knots": [0, 0, 1, 1], "homogeneous": [[0, 0, 1], [1, 0, -1]]})")[0];
  ASSERT_EQ(negative.notes.size(), 1u);
  EXPECT_NE(negative.notes[0].find("1 weights are not positive"), std::string::npos);
}

TEST(Recipes, HighDegreesOfLagrangeAreNoted) {
  std::string nodes, points;
  for (int i = 0; i <= 30; ++i) {
    nodes += (i > 0 ? ", " : "") + std::to_string(i);
    points += (i > 0 ? ", [" : "[") + std::to_string(i) + ", " + std::to_string(i % 2) + "]";
  }
  const Recipe recipe =
      parse(R"({"kind": "lagrange_curve", "nodes": [)" + nodes + R"(], "points": [)" + points + "]}")[0];
  ASSERT_EQ(recipe.notes.size(), 1u);
  EXPECT_NE(recipe.notes[0].find("degree 30"), std::string::npos);
  EXPECT_FALSE(recipe.curve()->net);
  expect_error<UnsupportedTopology>([&] { net_file({recipe}); }, {"its degree is too high"});
}

/// Text, and what the message says.
struct Wrong {
  std::string text;
  std::initializer_list<std::string_view> parts;
};

TEST(Recipes, WrongFilesAreNamed) {
  std::string deep;
  for (int i = 0; i < 100; ++i) deep += "[";
  for (const Wrong& wrong : std::initializer_list<Wrong>{
           {"", {"r.json:1: not JSON"}},
           {"{\n\"kind\": }", {"r.json:2: not JSON"}},
           {"[]", {"r.json: holds an array", "\"recipes\""}},
           {"3", {"r.json: holds 3"}},
           {R"({"recipes": []})", {"recipes is empty"}},
           {R"({"recipes": 3})", {"r.json: recipes is"}},
           {R"({"recipes": [3]})", {"recipe 0 is 3"}},
           {R"({"recipes": [{"recipes": []}]})", {"recipe 0", "do not nest"}},
           {R"({"recipes": [{"kind": "x"}], "recipe": 1})", {"unknown field \"recipe\"", "recipes"}},
           {"{}", {"recipe 0", "kind is missing"}},
           {R"({"kind": 3})", {"kind: is 3"}},
           {R"({"kind": "rulled"})", {"unknown kind \"rulled\"; the nearest are ruled"}},
           {R"({"kind": "coons"})", {"nearest are coons_bilinear, coons_bicubic, coons_general"}},
           {R"({"name": "wing", "kind": "extrusoin"})", {"recipe 0 'wing': unknown kind"}},
           {R"({"kind": "ruled", "kind": "cone"})", {"r.json: has the field \"kind\" twice"}},
           {R"({"kind": "ruled", "name": 7})", {"name: is 7"}},
           {R"({"kind": "ruled", "name": "a\nb"})", {"name: is too long or has line ends"}},
           {R"({"kind": "implicit", "field": )" + deep, {"nests deeper"}},
           {R"({"kind": "taylor_curve", "points": [[1e999]]})", {"r.json:1: not JSON", "number overflow"}},
           {R"({"kind": "taylor_curve", "points": [[1e308], [1e308], [1e308]]})",
            {"r.json: recipe 0 (taylor_curve)", "control point 2", "inf", "overflow"}},
           {R"({"kind": "taylor_curve", "points": [[NaN]]})", {"r.json:1: not JSON"}}})
    expect_error<FormatError>([&] { parse(wrong.text); }, wrong.parts);
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from << " in " << text;
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

TEST(Recipes, WrongFieldsAreNamed) {
  const auto with = [](const char* kind, const char* from, const char* to) {
    return replaced(sample_recipe(kind), from, to);
  };
  for (const Wrong& wrong : std::initializer_list<Wrong>{
           {sample_recipe("cone", R"("appex": [0], )"),
            {"recipe 0 (cone): unknown field \"appex\"; the nearest are apex"}},
           {with("cone", "apex", "apax"), {"(cone): the field apex is missing"}},
           {with("cone", R"("points")", R"("pionts")"), {"curve.points is missing"}},
           {with("cone", R"("degree": 2)", R"("degree": 2, "dgree": 1)"),
            {"unknown field \"dgree\" in curve; the nearest are degree"}},
           {with("cone", R"({"degree")", R"({"kind": "bspline_curve", "degree")"),
            {"curve: is a recipe of its own", "do not nest"}},
           {with("cone", "[1, 0, 1]", "[1, 0, 1, 1]"), {"apex: has 4 numbers; it should have 2 or 3"}},
           {with("cone", "[1, 0, 1]", R"([1, 0, "1/0"])"),
            {"apex[2]: is \"1/0\"; it should be a number, or a fraction"}},
           {with("cone", "[0, 0, 0, 1, 1, 1]", "[0, 0, 0, 1, 1]"),
            {"curve.knots: 5 knots for 3 control points of degree 2: 6 are needed, or 4"}},
           {with("cone", "[0, 0, 0, 1, 1, 1]", "[0, 0, 0, 1, 1, 0]"),
            {"curve.knots: knot 5 is 0, less than the one before"}},
           {with("cone", "[0, 0, 0, 1, 1, 1]", "[0, 0, 0, 0, 0, 0]"), {"curve.knots:", "length"}},
           {with("cone", "[1, 1]", "[1, 1, 0]"), {"curve.points[1]: has 3 numbers, those before have 2"}},
           {with("cone", "[1, 1]", "[1]"), {"curve.points[1]: has 1 numbers; it should have 2 or 3"}},
           {with("cone", "[1, 1]", "true"), {"curve.points[1]: is true"}},
           {with("cone", R"("degree": 2)", R"("degree": 2.5)"),
            {"curve.degree: is 2.5; it should be a whole number from 0 to 25"}},
           {with("cone", R"("degree": 2)", R"("degree": 1000000000)"), {"curve.degree: is 1000000000"}},
           {with("bezier_curve", R"("degree": 2)", R"("degree": 3)"), {"points: has 3 points; degree 3 needs 4"}},
           {with("bezier_curve", "[0, 2]", "[2, 0]"), {"domain: is 2 to 0; it must rise"}},
           {with("bezier_curve", "[0, 2]", "[0, 1, 2]"), {"domain: has 3 numbers; it should have 2"}},
           {with("bmatrix_curve", "[[1, -1], [0, 1]]", "[[1, -1]]"), {"matrix: has 1 rows; degree 1 needs 2"}},
           {with("bmatrix_curve", "[0, 1, 3]", "[0, 1]"), {"2 ends of 2 segments: 3 are needed"}},
           {with("bmatrix_curve", R"("step": 1)", R"("step": 0)"), {"step: is 0"}},
           {with("lagrange_curve", "[0, 1, 3]", "[0, 1, 0]"), {"nodes 0 and 2 are both 0"}},
           {with("lagrange_curve", "[0, 1, 3]", "[0, 1]"), {"points: has 3 points; 2 nodes needs 2"}},
           {with("hermite_curve", "[[0, 1], [0, -1]]", "[[0, 1]]"),
            {"tangents: has 1 points; a Hermite curve needs 2"}},
           {with("bspline_curve", "[0, 1, 2, 3]", "[0, 1, 2]"),
            {"knots: 3 break points of a closed spline: 4 are needed"}},
           {with("bspline_curve", "true", "1"), {"closed: is 1; it should be true or false"}},
           {with("nurbs_curve", "[[1, 0, 1], [1, 1, 1], [0, 2, 2]]", "[[1, 0, 0], [1, 1, 0], [0, 2, 0]]"),
            {"homogeneous: all weights are 0"}},
           {sample_recipe("nurbs_curve", R"("points": [[0, 0]], )"), {"homogeneous: comes with points"}},
           {with("interpolate_bspline", "[0, 1, 2, 4]", "[0, 1, 1, 4]"), {"parameters 1 and 2 are both 1"}},
           {sample_recipe("interpolate_bspline", R"("knots": [0, 0, 1.5, 2, 3, 4, 4], )"),
            {"parameter 0 is 0", "knots 0 and 3"}},
           {with("interpolate_cubic", "natural", "naturl"),
            {"ends: is \"naturl\"; it should be one of natural, clamped, periodic"}},
           {with("interpolate_cubic", "natural", "clamped"), {"0 end derivatives", "clamped need 2"}},
           {with("bezier_surface", "[1, 1]", "[1, 2]"), {"points: has 4 entries; degree [1, 2] needs 2 x 3"}},
           {with("bezier_surface", "[1, 1]", "[1]"), {"degree: has 1 numbers; it should have 2"}},
           {with("bezier_triangle", R"("degree": 1)", R"("degree": 2)"), {"points: has 3 points; degree 2 needs 6"}},
           {with("bspline_surface", "[2, 3]", "[1000000000, 1000000000]"),
            {"points: has 6 entries; the shape needs 1000000000 x 1000000000"}},
           {with("functional_surface", "[0, 1, 2, 3]", "[0, 1, 2]"), {"values: has 3 numbers; the knots need 2 x 2"}},
           {with("lagrange_surface", "[0, 2]", "[0, 0]"), {"nodes_v: nodes 0 and 1 are both 0"}},
           {with("hermite_surface", "\"12\"", "\"13\""), {"vectors: is \"13\"; it should be one of 12, 16, adini"}},
           {with("hermite_surface", "\"12\"", "\"16\""), {"the field puv is missing"}},
           {sample_recipe("hermite_surface", R"("puv": [[0, 0, 0]], )"), {"puv: comes with vectors \"12\""}},
           {with("coons_bilinear", "[0, 0, 1, 1]", "[0, 0, 2, 2]"), {"c0: its domain is 0 to 2"}},
           {sample_recipe("coons_bilinear", R"("tolerance": -1, )"), {"tolerance: is -1"}},
           {with("revolution", "360", "720"), {"a sweep of 720 degrees"}},
           {sample_recipe("revolution", R"("arcs": 2, )"), {"2 arcs of 360 degrees", "3 or more"}},
           {with("revolution", "[0, 0, 1]}", "[0, 0, 0]}"), {"axis"}},
           {with("screw", "[0, 3]", "[3, 0]"), {"u from 3 to 0"}},
           {with("sweep", "[[1, 0, 0], [0, 1, 0], [0, 0, 1]]", "[[1, 0, 0], [0, 1, 0]]"), {"matrices[0]: has 2 rows"}},
           {with("loft", "[0, 1, 2]", "[0, 1]"), {"2 parameters for 3 sections"}},
           {with("gordon", "lagrange", "bilinear"),
            {"blending: is \"bilinear\"; it should be one of lagrange, spline"}},
           {with("gordon", "[0, 1]", "[0, 2]"), {"parameters_u"}},
           {with("ruled", "[0, 0, 1, 1]", "[0, 0, 3, 3]"), {"(ruled): the domain of curve 1"}},
           {with("nielson", R"("normals")", R"("normal")"), {"normals is missing"}},
           {sample_recipe("piper", R"("points": [], )"), {"mesh: comes with points"}},
           {sample_recipe("piper", R"("normals": [[0, 0, 1]], )"), {"normals", "given, estimated"}},
           {with("curve_join", R"("length": 2)", R"("length": 0)"), {"left.length: is 0"}},
           {with("surface_join", R"("degree": [1, 1])", R"("degree": [2, 1])"),
            {"left.points: has 4 points; the degrees need 6"}}}) {
    SCOPED_TRACE(wrong.text);
    expect_error<FormatError>([&] { parse(wrong.text); }, wrong.parts);
  }
}

TEST(Recipes, GapsAreInvalidMeshes) {
  const std::string apart =
      replaced(sample_recipe("coons_bicubic"), "[[0, 0, 0], [1, 0, 0]]", "[[0, 0, 0.5], [1, 0, 0]]");
  expect_error<InvalidMesh>([&] { parse(apart); }, {"r.json: recipe 0 (coons_bicubic): corner (0,0)", "0.5 apart"});
  const Recipe averaged = parse(replaced(apart, "1e-6", "1"))[0];
  ASSERT_EQ(averaged.notes.size(), 1u);
  EXPECT_NE(averaged.notes[0].find("corners are averaged"), std::string::npos);
  const std::string twists =
      replaced(sample_recipe("coons_general"), R"("twists": [[0, 0, 1])", R"("twists": [[0, 0, 2])");
  expect_error<InvalidMesh>([&] { parse(twists); }, {"(coons_general): corner (0,0)", "twist differ by 1"});
  const std::string network = replaced(sample_recipe("gordon"), "[[0, 1, 0], [1, 1, 1]]", "[[0, 1, 0], [1, 1, 2]]");
  expect_error<InvalidMesh>([&] { parse(network); }, {"curves_u[1] and curves_v[1] are 1 apart"});
}

TEST(NetFile, ReadsBackAsTheSameCurvesAndSurfaces) {
  for (const auto& [kind, fields] : sample_fields()) {
    SCOPED_TRACE(kind);
    const std::vector<Recipe> recipes = parse(sample_recipe(kind, R"("name": "a", )"));
    const bool has_net = (recipes[0].surface() && recipes[0].surface()->net) || recipes[0].curve();
    if (!has_net) {
      expect_error<UnsupportedTopology>([&] { net_file(recipes); },
                                        {"r.json: recipe 0 'a' (" + kind + "): there is no exact net to write: "});
      continue;
    }
    const FreeForm again = parse_free_form(format_free_form(net_file(recipes)), "n.obj");
    EXPECT_TRUE(again.warnings.empty());
    EXPECT_EQ(again.names, std::vector<std::string>{"a"});
    ASSERT_EQ(again.curves.size() + again.surfaces.size(), 1u);
    const FreeFormElement& element =
        again.curves.empty() ? static_cast<const FreeFormElement&>(again.surfaces[0]) : again.curves[0];
    const Coordinates coordinates =
        recipes[0].curve() ? recipes[0].curve()->coordinates : recipes[0].surface()->coordinates;
    EXPECT_EQ(element.rational, coordinates == Coordinates::homogeneous);
    EXPECT_TRUE(element.basis == FreeFormBasis::bezier || element.basis == FreeFormBasis::bspline);
    const auto knots = [&](const FreeFormDirection& d) {
      if (element.basis == FreeFormBasis::bspline) return Knots<double>::open(d.degree, d.count, d.parameters);
      std::vector<double> all(size_t(d.degree) + 1, d.first);
      all.insert(all.end(), size_t(d.degree) + 1, d.last);
      return Knots<double>::open(d.degree, d.count, all);
    };
    Points columns(std::ssize(element.points), 4);
    for (size_t i = 0; i < element.points.size(); ++i) {
      const double w = again.weights[size_t(element.points[i])];
      columns.row(Index(i)) << (w == 0 ? 1 : w) * again.vertices.row(element.points[i]), w;
    }
    if (const RecipeCurve* const curve = recipes[0].curve()) {
      const CurveNet read{knots(again.curves[0].u), columns, Coordinates::homogeneous};
      CurveNet given = homogeneous(*curve->net);
      for (const double t : {0.1, 0.5, 0.9}) {
        const double at = read.knots.begin() + t * (read.knots.end() - read.knots.begin());
        const Eigen::RowVectorXd a = truth(read, at), b = truth(given, at);
        expect_near(a.head(2), b.head(2), sums);
        EXPECT_NEAR(a[3], b[b.size() - 1], sums);
      }
    } else {
      const FreeFormSurface& surface = again.surfaces[0];
      const SplineNet read = spline_net(knots(surface.u), knots(surface.v), columns, Coordinates::homogeneous);
      const RecipeSurface& given = *recipes[0].surface();
      for (const double s : {0.1, 0.8}) {
        const Knots<double>&u = given.net->surface->u(), &v = given.net->surface->v();
        const double x = u.begin() + s * (u.end() - u.begin()), y = v.begin() + 0.3 * (v.end() - v.begin());
        expect_near(own_values(read, x, y).x.row(0), own_values(*given.net, x, y).x.row(0), sums);
      }
    }
  }
}

TEST(NetFile, SaysWhatObjDoesNotHave) {
  const std::string steps = R"({"kind": "bspline_curve", "degree": 0, "knots": [0, 1, 2], "points": [[0, 0], [1, 0]]})";
  expect_error<UnsupportedTopology>([&] { net_file(parse(steps)); }, {"degree 0 in t"});
  const std::string jump =
      R"({"kind": "bspline_curve", "degree": 1, "knots": [0, 0, 1, 1, 2, 2], "points": [[0, 0], [1, 0], [2, 0], [3, 0]]})";
  expect_error<UnsupportedTopology>([&] { net_file(parse(jump)); }, {"it jumps at t = 1"});
  const std::string wide = R"({"kind": "bezier_curve", "degree": 1, "points": [[0, 0, 0, 0], [1, 0, 0, 0]]})";
  expect_error<UnsupportedTopology>([&] { net_file(parse(wide)); }, {"4 coordinates, OBJ has 3"});
}

}  // namespace
}  // namespace sublimit::testing
