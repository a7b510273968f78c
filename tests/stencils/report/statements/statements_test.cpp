// SPDX-License-Identifier: Apache-2.0
#include "sublimit/report/statements/statements.h"

#include <gtest/gtest.h>

#include <map>

#include "sublimit/curves/schemes/curve_schemes.h"
#include "sublimit/report/statements/curves.h"
#include "sublimit/report/statements/meshes.h"
#include "sublimit/report/statements/misreadings.h"
#include "sublimit/report/statements/patches.h"
#include "sublimit/report/statements/regular.h"
#include "sublimit/report/statements/small_meshes.h"
#include "sublimit/report/statements/spectra.h"
#include "sublimit/report/statements/splines.h"

namespace sublimit::report {
namespace {

const Json& all() {
  static const Json json = statements_json();
  return json;
}

/// Of the sentence that begins so; by where it stands if several do.
std::string verdict(const std::string& where, const std::string& says) {
  std::string found;
  for (const Json& s : all())
    if (s["where"].get<std::string>().find(where) != std::string::npos &&
        s["says"].get<std::string>().rfind(says, 0) == 0)
      found += (found.empty() ? "" : ", ") + s["verdict"].get<std::string>();
  return found;
}

TEST(Statements, AreDecidedAsTheErrataHaveThem) {
  struct Expected {
    const char *where, *says, *verdict;
  };
  for (const Expected& e : {
           Expected{"000, sqrt(3)", "sqrt(3) interpolates", "refuted"},
           {"000, table", "sqrt(3) is C^2", "confirmed"},
           {"000, Doo-Sabin", "a new point is the midpoint", "refuted"},
           {"000, Doo-Sabin", "the new point is a sum", "refuted"},
           {"000, table", "Doo-Sabin is C^0", "refuted"},
           {"003, Doo-Sabin", "C^1", "confirmed"},
           {"003, Doo-Sabin", "weights", "confirmed"},
           {"002, Doo-Sabin", "a new point is the mean", "confirmed"},
           {"002, Doo-Sabin", "that mean has", "depends"},
           {"004, Doo-Sabin", "G^1", "confirmed"},
           {"mid-edge", "two mid-edge steps", "refuted"},
           {"mid-edge", "edge points", "refuted"},
           {"mid-edge", "C^1 everywhere", "depends"},
           {"000, Catmull-Clark", "R is", "confirmed"},
           {"002 and 004, Catmull-Clark", "R is", "refuted"},
           {"000, Catmull-Clark", "3/(2n)", "confirmed"},
           {"000, table", "Catmull-Clark is C^2", "confirmed"},
           {"000, Loop", "beta = 5/8", "confirmed"},
           {"000, Loop", "beta is to be divided", "refuted"},
           {"000, butterfly", "the mask", "refuted"},
           {"000, butterfly", "C^1 except", "depends"},
           {"modified butterfly", "the formula", "refuted"},
           {"modified butterfly", "C^1", "confirmed"},
           {"000, Kobbelt", "C^1", "confirmed"},
           {"000, Kobbelt", "both ways", "depends"},
           {"Kobbelt", "virtual points", "refuted"},
           {"Kobbelt", "face points", "refuted"},
           {"000", "these are schemes for quad", "refuted"},
           {"003", "the number of other polygons", "refuted"},
           {"003", "a V-face joins", "refuted"},
           {"000", "regular border vertices", "depends"},
           {"000", "B-splines describe", "refuted"},
           {"modified butterfly", "borders", "depends"},
           {"texts on Catmull-Clark", "borders", "depends"},
           {"texts on Loop", "borders", "depends"},
           {"004", "interpolation has", "depends"},
           {"four-point", "C^1 for tensions", "confirmed"},
           {"four-point", "not C^1", "refuted"},
           {"Lane-Riesenfeld", "midpoints inserted", "confirmed"},
           {"Hermite scheme", "the incentre scheme", "confirmed"},
           {"001", "a spline of degree n", "refuted"},
           {"001", "the first factor", "refuted"},
           {"001", "a basis function", "refuted"},
           {"001", "basis functions sum", "depends"},
           {"001 and 002", "degree k is", "depends"},
           {"001", "a name from Coons", "refuted"},
           {"001", "a factor of tangents", "depends"},
           {"001", "G^0", "refuted"},
           {"001", "what curves are invariant to", "refuted"},
           {"001", "P(u_k, u_l)", "refuted"},
           {"002, Hermite patch", "approximates", "refuted"},
           {"002, Hermite patch", "four twist", "refuted"},
       })
    EXPECT_EQ(verdict(e.where, e.says), e.verdict) << e.where << ": " << e.says;
  EXPECT_EQ(all().size(), 52u);
}

TEST(Statements, AreWholeAndTheSameEveryTime) {
  const Json again = to_json(all_statements().subspan(2, 20));  // without those that take long
  EXPECT_EQ(again, Json(all().begin() + 2, all().begin() + 22));
  for (const Json& s : all()) {
    std::vector<std::string> keys;
    for (const auto& [key, value] : s.items()) keys.push_back(key);
    EXPECT_EQ(keys, (std::vector<std::string>{"where", "says", "verdict", "right", "experiment", "numbers"}));
    EXPECT_FALSE(s["experiment"].get<std::string>().empty()) << s["says"];
    EXPECT_TRUE(s["verdict"] == "confirmed" || !s["right"].is_null()) << s["says"];
  }
}

Scheme<Algebraic> exact(const char* name) { return find_scheme<Algebraic>(name).value(); }

// In this order: g++ 12 fails where Loop's scheme is the first to need defaults of masks of doubles.
ReportedScheme halfway() {
  return both_of(misread::doo_sabin_halfway<double>(), misread::doo_sabin_halfway<Algebraic>());
}
ReportedScheme loop_divided_twice() {
  return both_of(misread::loop_divided_twice<double>(), misread::loop_divided_twice<Algebraic>());
}

// Put right, each sentence gets the other verdict from the same experiment.
TEST(Statements, ExperimentsOnSpectraTurnWithTheMask) {
  EXPECT_EQ(is_c1(reported_scheme("loop"), {5, 6}).fate, Fate::confirmed);
  EXPECT_EQ(is_c1(loop_divided_twice(), {5}).fate, Fate::refuted);
  EXPECT_EQ(is_c1(reported_scheme("doo-sabin"), {3, 5}).fate, Fate::confirmed);
  EXPECT_EQ(is_c1(halfway(), {3}).fate, Fate::refuted);  // its triangles lie among quadrilaterals that fail
  EXPECT_EQ(is_c1(reported_scheme("butterfly"), {4, 7}).fate, Fate::confirmed);
  EXPECT_EQ(is_c1(reported_scheme("butterfly"), {3, 8}).fate, Fate::refuted);
  EXPECT_EQ(is_c1(reported_scheme("mid-edge"), {4, 5}).fate, Fate::confirmed);
  EXPECT_EQ(is_c1(reported_scheme("mid-edge"), {3}).fate, Fate::depends);
  EXPECT_EQ(is_affine(exact("doo-sabin"), {3, 5}).fate, Fate::confirmed);
  EXPECT_EQ(keeps_centroids(exact("mid-edge"), {3, 5}).fate, Fate::confirmed);
  EXPECT_EQ(has_border_planes(exact("catmull-clark"), {1, 2, 3, 4}).fate, Fate::confirmed);
  EXPECT_EQ(has_border_planes(exact("catmull-clark"), {5, 6}).fate, Fate::refuted);
}

// A corner's weights that are not the same in all corners move centroids.
TEST(Statements, CentroidsMoveUnderAnotherMask) {
  const auto leaning = doo_sabin_with<Algebraic>("leaning", "", [](const FaceSite<Algebraic>& f, int j) {
    return j == 0 ? f.ratio(3, 4) : j == 1 ? f.ratio(1, 4) : Algebraic(0);
  });
  EXPECT_EQ(keeps_centroids(leaning, {3, 4}).fate, Fate::confirmed);  // circulant: columns sum to 1 as rows do
  EXPECT_EQ(keeps_centroids(misread::doo_sabin_with_one_term_more<Algebraic>(), {3, 4}).fate, Fate::refuted);
}

TEST(Statements, ExperimentsOnRegularMasksTurnWithTheMask) {
  const Directions cubic = tensor_directions(3);
  EXPECT_EQ(is_box_spline(misread::catmull_clark_with_old_midpoints<Algebraic>(), cubic).fate, Fate::confirmed);
  EXPECT_EQ(is_box_spline(misread::catmull_clark_with_new_edge_points<Algebraic>(), cubic).fate, Fate::refuted);
  EXPECT_EQ(is_smooth_box_spline(exact("catmull-clark"), cubic, 3).fate, Fate::refuted);
  EXPECT_EQ(is_smooth_box_spline(exact("mid-edge"), {{1, 0}, {0, 1}, {1, 1}, {1, -1}}, 1).fate, Fate::confirmed);
  EXPECT_EQ(same_regular_mask(exact("mid-edge"), misread::doo_sabin_of_three_corners<Algebraic>()).fate,
            Fate::confirmed);
  EXPECT_EQ(same_regular_mask(exact("modified-butterfly"), exact("butterfly")).fate, Fate::confirmed);
  const auto ten_points = find_scheme<Algebraic>("modified-butterfly", {{"t", "-1/48"}}).value();
  EXPECT_EQ(same_regular_mask(misread::modified_butterfly_with_one_formula<Algebraic>(), ten_points).fate,
            Fate::confirmed);
  EXPECT_EQ(is_regularly_smooth(exact("kobbelt"), 2).fate, Fate::depends);  // exponent 2, a logarithm away from it
  EXPECT_EQ(is_regularly_smooth(exact("kobbelt"), 3).fate, Fate::refuted);
  EXPECT_EQ(is_regularly_smooth(exact("catmull-clark"), 2).fate, Fate::confirmed);
  EXPECT_EQ(vertex_mask_has_points(exact("butterfly"), 1).fate, Fate::confirmed);
}

TEST(Statements, KobbeltsVirtualPointMustHaveItsWeight) {
  const auto agree = [](Ratio r) {
    return same_rule(misread::kobbelt_one_way<Algebraic>(0, r), misread::kobbelt_one_way<Algebraic>(1, r), {3, 5}, 2);
  };
  EXPECT_EQ(agree({1, 9}).fate, Fate::confirmed);
  EXPECT_EQ(agree({1, 5}).fate, Fate::refuted);
  EXPECT_EQ(face_point_uses_rows(2).fate, Fate::confirmed);
  const auto way = [](int k) { return misread::kobbelt_one_way<double>(k, {1, 9}); };
  EXPECT_EQ(same_points(way(0), way(1), torus(6, 7)).fate, Fate::confirmed);
}

TEST(Statements, ExperimentsOnMeshesTurnWithTheSentence) {
  EXPECT_EQ(need_quads({"loop"}).fate, Fate::confirmed);  // refuses pentagons
  EXPECT_EQ(polygons_stay_from("doo-sabin", 1).fate, Fate::confirmed);
  EXPECT_EQ(polygons_stay_from("catmull-clark", 1).fate, Fate::confirmed);  // none are left
  EXPECT_EQ(border_depends_on_inside("virtual-vertex").fate, Fate::confirmed);
  EXPECT_EQ(border_depends_on_inside("four-point").fate, Fate::refuted);
  EXPECT_EQ(interpolation_is_solvable({{"torus", torus(6, 8)}}, "catmull-clark").fate, Fate::confirmed);
  EXPECT_EQ(interpolation_is_solvable({{"cube", prism(4)}}, "catmull-clark").fate, Fate::refuted);
}

TEST(Statements, ExperimentsOnCurvesTurnWithTheMask) {
  EXPECT_EQ(four_point_is_c1({{1, 1}}).fate, Fate::confirmed);
  EXPECT_EQ(four_point_is_c1({{-1, 2}}).fate, Fate::refuted);
  EXPECT_EQ(four_point_is_c1({{16, 5}}).fate, Fate::refuted);  // above 3.0837
  EXPECT_EQ(averagings_give_degree(0).fate, Fate::refuted);
  GeometricCurveScheme keeping = hermite_incentre({});
  keeping.refine = [](const ControlPolygon& p) { return p; };
  EXPECT_EQ(is_g1(keeping).fate, Fate::refuted);
}

TEST(Statements, ExperimentsOnSplinesTurnWithTheSentence) {
  EXPECT_EQ(pieces_have_degree(0).fate, Fate::confirmed);
  EXPECT_EQ(first_factor(true).fate, Fate::confirmed);
  EXPECT_EQ(one_function_has_knots(2).fate, Fate::confirmed);
  EXPECT_EQ(functions_sum_to_one(false).fate, Fate::confirmed);
  EXPECT_EQ(continuous_at_knots({1}).fate, Fate::confirmed);
  EXPECT_EQ(continuous_at_knots({2, 3}).fate, Fate::refuted);
  EXPECT_EQ(continuous_at_knots({3}, 3).fate, Fate::confirmed);
}

TEST(Statements, ExperimentsOnPatchesTurnWithTheSentence) {
  EXPECT_EQ(joint_is_g2(2).fate, Fate::confirmed);
  EXPECT_EQ(joint_is_g2(-2).fate, Fate::refuted);
  EXPECT_EQ(lagrange_patch_interpolates(false).fate, Fate::confirmed);
  EXPECT_EQ(twists_at_a_corner(1).fate, Fate::confirmed);
}

TEST(Statements, FatesCombine) {
  EXPECT_EQ(fate({true, false}), Fate::depends);
  EXPECT_EQ(denied({Fate::depends, "", {}}).fate, Fate::depends);
  EXPECT_EQ(denied({Fate::refuted, "", {}}).fate, Fate::confirmed);
  for (const Fate a : {Fate::confirmed, Fate::refuted, Fate::depends}) {
    EXPECT_EQ(both({a, "", {}}, {Fate::refuted, "", {}}).fate, Fate::refuted);
    EXPECT_EQ(both({a, "", {}}, {Fate::confirmed, "", {}}).fate, a);
  }
}

}  // namespace
}  // namespace sublimit::report
