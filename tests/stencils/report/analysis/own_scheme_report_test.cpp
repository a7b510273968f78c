// SPDX-License-Identifier: Apache-2.0
// Reports of schemes that the registry does not have, and of wrong ones: disproved, and for the right reason.
#include <gtest/gtest.h>

#include "laws/misreadings.h"
#include "stencils/cli_program.h"
#include "sublimit/base/error.h"
#include "sublimit/certificates/regularity/sweep.h"
#include "sublimit/report/analysis/scheme_report.h"
#include "sublimit/report/analysis/verify_report.h"
#include "sublimit/stencils/json/numbers.h"
#include "support/expect_error.h"

namespace sublimit::testing {
namespace {

using report::Json;
using report::ReportedScheme;

/// A file of one's own: Catmull-Clark, but old vertices stay where they are.
template <class T>
Scheme<T> staying() {
  Scheme<T> scheme = *find_scheme<T>("catmull-clark");
  scheme.name = "staying";
  scheme.steps[0].masks.vertex = [](const Ring<T>& v) { return v.center(); };
  return scheme;
}

/// Another one: Catmull-Clark under a name of its own, and with a claim that is false.
template <class T>
Scheme<T> boasting() {
  Scheme<T> scheme = *find_scheme<T>("catmull-clark");
  scheme.name = "boasting";
  scheme.claims.extraordinary = 2;
  return scheme;
}

Json report_of(const ReportedScheme& scheme, const std::vector<int>& valences) {
  const Json report = report::schemes_report({scheme}, {.valences = valences});
  // Negative ones are sound reports too.
  for (const std::string& finding : report::verify_report(report.dump(), {.analyse_masks = false}).findings)
    ADD_FAILURE() << finding;
  return report;
}

/// The verdict on c1 inside, at valence (or of a face with) n.
const Json& c1(const Json& report, int n) {
  for (const Json& at : report["schemes"][0]["neighborhoods"])
    if ((at["kind"] == "vertex" || at["kind"] == "face") && at["n"] == n)
      for (const Json& v : at["verdicts"])
        if (v["property"] == "c1") return v;
  throw std::runtime_error("no verdict at n = " + std::to_string(n));
}

/// What fails, of the hypotheses of a verdict.
std::string failing(const Json& verdict) {
  std::string all;
  for (const Json& h : verdict["hypotheses"])
    if (h["holds"] == false) all += h["says"].get<std::string>() + ": " + h["value"].get<std::string>() + "\n";
  return all;
}

/// The claim of this name.
const Json& claim(const Json& report, const std::string& name) {
  for (const Json& c : report["schemes"][0]["claims"])
    if (c["claim"] == name) return c;
  throw std::runtime_error("no claim " + name);
}

void expect_disproved(const Json& report, const std::vector<int>& valences,
                      std::initializer_list<std::string_view> reasons) {
  for (const int n : valences) {
    SCOPED_TRACE(n);
    EXPECT_EQ(c1(report, n)["verdict"], "disproved");
    expect_parts(c1(report, n)["because"].get<std::string>() + "\n" + failing(c1(report, n)), reasons);
  }
}

TEST(OwnSchemeReport, VerticesThatStayAreSpikes) {
  const Json report = report_of({staying<double>(), staying<Algebraic>()}, {3, 4, 7});
  // Block 0 of centre, ring and diagonals: 1 and the roots of x^2 - 3/4 x + 1/16, whatever the valence.
  expect_disproved(report, {3, 4, 7}, {"block 0 leads", "3/8+sqrt(5/64)", "spike"});
  EXPECT_EQ(claim(report, "extraordinary")["verdict"], "disproved");
  EXPECT_EQ(claim(report, "regular")["verdict"], "disproved");
  EXPECT_EQ(claim(report, "reproduces")["verdict"], "proved");
  EXPECT_GE(report::contradicted_claims(report), 2);
  EXPECT_EQ(report["summary"][0]["extraordinary"], "C^0");
}

TEST(OwnSchemeReport, ClaimsThatAreFalseAreDisproved) {
  const Json report = report_of({boasting<double>(), boasting<Algebraic>()}, {3, 4, 5});
  for (const int n : {3, 4, 5}) {
    EXPECT_EQ(c1(report, n)["verdict"], "proved");
    EXPECT_EQ(c1(report, n)["witness"]["scheme"], "boasting");
  }
  EXPECT_EQ(claim(report, "extraordinary")["verdict"], "disproved");
  EXPECT_EQ(claim(report, "extraordinary")["found"], 1);
  // At 3 mu/lambda^2 = 0.991: a flat spot, which is C^2.
  expect_parts(claim(report, "extraordinary")["because"].get<std::string>(), {"disproved at 5", "proved at 3"});
  EXPECT_EQ(report::contradicted_claims(report), 1);
}

/// Vertices are pushed away from the mean of their neighbours.
template <class T>
Scheme<T> running_away() {
  Scheme<T> scheme = *find_scheme<T>("loop");
  scheme.name = "running-away";
  scheme.steps[0].masks.vertex = [](const Ring<T>& v) { return 3 * v.center() - 2 * v.neighbor_mean(); };
  return scheme;
}

/// Weights of vertices sum to 11/10.
template <class T>
Scheme<T> growing() {
  Scheme<T> scheme = *find_scheme<T>("catmull-clark");
  scheme.name = "growing";
  scheme.steps[0].masks.vertex = [](const Ring<T>& v) {
    return v.ratio(6, 10) * v.center() + v.ratio(5, 10) * v.neighbor_mean();
  };
  return scheme;
}

TEST(OwnSchemeReport, SchemesThatDivergeAreDisprovedByTheirEigenvalue) {
  const Json report = report_of({running_away<double>(), running_away<Algebraic>()}, {3, 6, 7});
  const Json& scheme = report["schemes"][0];
  // Of the centre and the mean of its ring: (3 -2; 3/8 5/8), eigenvalues of x^2 - 29/8 x + 21/8.
  for (const Json& n : scheme["neighborhoods"]) {
    if (n["kind"] != "vertex") continue;
    const Json& convergence = n["verdicts"][1];
    EXPECT_EQ(convergence["property"], "convergence");
    EXPECT_EQ(convergence["verdict"], "disproved") << n["n"];
    expect_parts(convergence["because"].get<std::string>(), {"larger than 1", "21/8", "run away"});
    EXPECT_EQ(n["masks"], nullptr);
    EXPECT_EQ(n["surface"], nullptr);
  }
  expect_disproved(report, {3, 6, 7}, {"there is no limit", "21/8"});
  EXPECT_EQ(claim(report, "regular")["verdict"], "disproved");
  EXPECT_EQ(claim(report, "convex-hull")["verdict"], "disproved");
  EXPECT_EQ(report["summary"][0]["extraordinary_verdict"], "disproved");
}

TEST(OwnSchemeReport, MasksThatDoNotSumToOneAreRefused) {
  expect_error<InvalidParameter>(
      [] {
        report_of({growing<double>(), growing<Algebraic>()}, {4});  // where the sum has no rounding
      },
      {"growing.vertex", "1.1", "sum of 1"});
}

TEST(OwnSchemeReport, TypesNeedNoClaim) {
  Scheme<double> scheme = staying<double>();
  scheme.claims = {};
  const Json report = report_of({scheme, staying<Algebraic>()}, {3});
  EXPECT_EQ(report["schemes"][0]["interpolates"], true);
  EXPECT_EQ(report["summary"][0]["type"], "interpolating");
  // Its borders have Catmull-Clark's rules: that all vertices stay would be false.
  expect_parts(report["summary"][0]["notes"].get<std::string>(), {"a vertex moves: border"});
  scheme.claims.interpolates = true;
  const Json claimed = report_of({scheme, staying<Algebraic>()}, {3});
  EXPECT_EQ(claim(claimed, "interpolates")["verdict"], "disproved");
  expect_parts(claim(claimed, "interpolates")["because"].get<std::string>(), {"border"});
}

TEST(OwnSchemeReport, Sqrt3WithoutRelaxationHasSpikes) {
  // Two steps of 2/3 in block 0, against (4/9) cos^2(pi/n). Under a name of its own: it is not the registry's.
  ReportedScheme scheme{misread::sqrt3_without_relaxation<double>(), misread::sqrt3_without_relaxation<Algebraic>()};
  scheme.scheme.name = scheme.exact.name = "sqrt3-without-relaxation";
  expect_disproved(report_of(scheme, {3, 6}), {3, 6}, {"block 0 leads", "4/9 in block 0", "spike"});
}

TEST(OwnSchemeReport, DooSabinWithMidpointsHasNoTangentPlane) {
  const Json report =
      report_of({misread::doo_sabin_halfway<double>(), misread::doo_sabin_halfway<Algebraic>()}, {4, 5});
  expect_disproved(report, {4, 5}, {"blocks 1 and 2", "1/2 in block 2", "no tangent plane"});
  EXPECT_NE(claim(report, "regular")["verdict"], "proved");
}

TEST(OwnSchemeReport, ButterflyFailsAtThreeAndNine) {
  const Json report = report_of(report::reported_scheme("butterfly"), {3, 9});
  expect_disproved(report, {3}, {"block 0 leads", "Jordan block of size 3", "spike"});
  expect_disproved(report, {9}, {"block 2 leads", "winds 2 times"});
}

TEST(OwnSchemeReport, FourPointSchemeWithNegativeTensionIsNotC1) {
  const Sweep swept = sweep("four-point", sweep_range("tension=-1:1:1"));
  const auto answer = [&](size_t i) {
    for (const Verdict& v : swept.points[i].smoothness.verdicts)
      if (v.says == "C^1") return to_string(v.answer);
    return std::string();
  };
  EXPECT_EQ(answer(0), "disproved");
  EXPECT_LT(swept.points[0].smoothness.exponent_high, 1);
  EXPECT_EQ(answer(1), "disproved");  // the polygon
  EXPECT_EQ(answer(2), "proved");
}

}  // namespace
}  // namespace sublimit::testing
