// SPDX-License-Identifier: Apache-2.0
// Claims steer nothing: of every scheme of the registry a report without claims and one with wrong claims say the same,
// but for what becomes of the claims; and no false one is proved.
#include <gtest/gtest.h>

#include "meshes/meshes.h"
#include "sublimit/curves/schemes/curve_schemes.h"
#include "sublimit/report/analysis/claims_json.h"
#include "sublimit/report/analysis/regular_json.h"
#include "sublimit/report/analysis/scheme_report.h"
#include "sublimit/scheme/refine.h"
#include "sublimit/schemes/schemes.h"

namespace sublimit {
namespace {

using report::Json;

/// Beyond what any scheme here has, and below what claims may be.
constexpr int far_too_smooth = 9;

Claims no_claims() {
  Claims claims;
  claims.generates = claims.reproduces = 0;
  return claims;
}

Json report_with(const std::string& name, const Claims& claims) {
  report::ReportedScheme scheme = report::reported_scheme(name);
  scheme.scheme.claims = claims;
  scheme.exact.claims = claims;
  return report::schemes_report({scheme}, {.valences = {5}});
}

std::string verdict_on(const Json& claims, const std::string& name) {
  for (const Json& claim : claims)
    if (claim["claim"] == name) return claim["verdict"];
  return "";
}

/// What weights show on meshes: whether all vertices have a child that is the vertex itself, and no weight is negative.
struct Weights {
  bool stay = true, positive = true;
};
Weights weights_of(const Scheme<double>& scheme) {
  Weights found;
  const bool triangles = scheme.face_size() == 3;
  // With borders, and with vertices and faces of five.
  const std::vector<Mesh> meshes =
      triangles ? std::vector{testing::octahedron(), testing::triangle_grid(3, 3), testing::fan(5, 3, 2)}
                : std::vector{testing::cube(), testing::grid(3, 3), testing::prism(5), testing::fan(5, 4, 2)};
  for (const Mesh& mesh : meshes) {
    const std::vector<Level> levels = refine(scheme, mesh, 1);
    const SparseMatrix& S = levels[1].S;
    for (Index i = 0; i < S.rows(); ++i)
      for (SparseMatrix::InnerIterator it(S, i); it; ++it) {
        found.positive &= it.value() >= 0;
        if (i < levels[0].topology().num_vertices()) found.stay &= it.col() == i && it.value() == 1;
      }
  }
  found.stay &= !scheme.is_dual();
  return found;
}

class EverySurfaceScheme : public ::testing::TestWithParam<std::string> {};

TEST_P(EverySurfaceScheme, IsReportedWithoutRegardToItsClaims) {
  const Scheme<double> scheme = *find_scheme(GetParam());
  const Weights weights = weights_of(scheme);
  Claims wrong = no_claims();
  wrong.interpolates = !weights.stay, wrong.convex_hull = !weights.positive;
  wrong.regular = wrong.extraordinary = wrong.generates = wrong.reproduces = far_too_smooth;
  Json bare = report_with(GetParam(), no_claims()), boasting = report_with(GetParam(), wrong);
  EXPECT_EQ(bare["schemes"][0]["interpolates"], weights.stay);
  EXPECT_EQ(bare["summary"][0]["type"], weights.stay ? "interpolating" : "approximating");

  const Json& claims = boasting["schemes"][0]["claims"];
  EXPECT_EQ(claims.size(), 4u + !weights.stay + !weights.positive);
  for (const Json& claim : claims) EXPECT_NE(claim["verdict"], "proved") << claim;
  for (const char* name : {"regular", "extraordinary"}) EXPECT_NE(verdict_on(claims, name), "evidence-for") << name;
  EXPECT_EQ(verdict_on(claims, "interpolates"), weights.stay ? "" : "disproved");
  EXPECT_EQ(verdict_on(claims, "convex-hull"), weights.positive ? "" : "disproved");

  // The claims of the scheme's file, and those alone that are true.
  const Json& found = bare["schemes"][0];
  Claims right = scheme.claims;
  right.interpolates = weights.stay, right.convex_hull = weights.positive;
  const Json own = report::claims_json(right, found);
  for (const Json& claim : own) EXPECT_NE(claim["verdict"], "disproved") << claim;
  EXPECT_EQ(verdict_on(own, "interpolates"), weights.stay ? "proved" : "");
  EXPECT_EQ(verdict_on(own, "convex-hull"), weights.positive ? "proved" : "");
  for (int k = 0; k < far_too_smooth; ++k) {  // what is proved of a degree is proved of lower ones
    Claims less = right, more = right;
    less.regular = less.extraordinary = less.generates = less.reproduces = k;
    more.regular = more.extraordinary = more.generates = more.reproduces = k + 1;
    const Json of_less = report::claims_json(less, found), of_more = report::claims_json(more, found);
    for (const char* name : {"regular", "extraordinary", "generates", "reproduces"})
      EXPECT_TRUE(verdict_on(of_more, name) != "proved" || verdict_on(of_less, name) == "proved") << name << k;
  }

  for (Json* const report : {&bare, &boasting}) (*report)["schemes"][0].erase("claims");
  EXPECT_EQ(bare, boasting);
}

INSTANTIATE_TEST_SUITE_P(Reports, EverySurfaceScheme, ::testing::ValuesIn([] {
                           std::vector<std::string> names;
                           for (const Scheme<double>& scheme : all_schemes()) names.push_back(scheme.name);
                           return names;
                         }()),
                         [](const auto& tested) {
                           std::string name = tested.param;
                           std::erase(name, '-');
                           return name;
                         });

TEST(CurveReports, TypesAreThoseOfTheMasks) {
  for (const CurveScheme<double>& scheme : all_curve_schemes()) {
    const Json json = report::curve_scheme_json(scheme.name);
    // Points of a polygon that is no special one.
    ASSERT_TRUE(json["interpolates"].is_boolean()) << scheme.name;
    EXPECT_EQ(json["interpolates"], scheme.claims.interpolates) << scheme.name;
    for (const Json& claim : json["claims"]) EXPECT_NE(claim["verdict"], "disproved") << scheme.name << claim;
    EXPECT_EQ(verdict_on(json["claims"], "interpolates") != "",
              scheme.claims.interpolates && json["regular"].is_object())
        << scheme.name;
  }
}

TEST(ClaimsJson, NothingIsProvedOfNeighbourhoodsThatWereNotLookedAt) {
  const Json empty{{"mesh", "any"}, {"regular", nullptr}, {"neighborhoods", Json::array()}};
  Claims all = no_claims();
  all.interpolates = all.convex_hull = true;
  for (const Json& claim : report::claims_json(all, empty)) EXPECT_EQ(claim["verdict"], "unknown") << claim;
  EXPECT_EQ(report::interpolation(Json::array()).holds, std::nullopt);
  EXPECT_EQ(report::convexity(Json::array()).holds, std::nullopt);
  // Of the regular valence alone nothing follows for others.
  Json regular = empty;
  regular["neighborhoods"].push_back(
      {{"kind", "vertex"}, {"n", 4}, {"verdicts", {{{"property", "c1"}, {"verdict", "proved"}}}}});
  all.extraordinary = 1;
  EXPECT_EQ(verdict_on(report::claims_json(all, regular), "extraordinary"), "unknown");
  EXPECT_EQ(report::summary_row(
                {{"name", "own"}, {"mesh", "any"}, {"neighborhoods", regular["neighborhoods"]}})["extraordinary"],
            nullptr);
}

TEST(ClaimsJson, C3IsNotProvedByC2) {
  Json scheme{{"mesh", "any"}, {"regular", nullptr}};
  scheme["neighborhoods"].push_back(
      {{"kind", "vertex"},
       {"n", 3},
       {"verdicts", {{{"property", "c1"}, {"verdict", "proved"}}, {{"property", "c2"}, {"verdict", "proved"}}}}});
  Claims claims = no_claims();
  claims.extraordinary = 2;
  EXPECT_EQ(verdict_on(report::claims_json(claims, scheme), "extraordinary"), "proved");
  claims.extraordinary = 3;
  EXPECT_EQ(verdict_on(report::claims_json(claims, scheme), "extraordinary"), "unknown");
}

}  // namespace
}  // namespace sublimit
