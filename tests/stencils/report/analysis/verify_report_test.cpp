// SPDX-License-Identifier: Apache-2.0
// Reports are believed as far as their witnesses go: whatever is changed in one must be found, and told where it is.
#include "sublimit/report/analysis/verify_report.h"

#include <gtest/gtest.h>

#include <random>

#include "stencils/cli_program.h"
#include "sublimit/base/error.h"
#include "sublimit/report/analysis/claims_json.h"
#include "sublimit/report/analysis/regular_json.h"
#include "sublimit/report/analysis/scheme_report.h"
#include "sublimit/stencils/json/numbers.h"

namespace sublimit::testing {
namespace {

using report::Json;
using report::ReportVerification;
using report::verify_report;

/// Loop at valences 3 and 5.
const Json& good() {
  static const Json report = report::schemes_report({report::reported_scheme("loop")}, {.valences = {3, 5}});
  return report;
}

/// The verdict on a property at the vertex of valence 5.
Json& verdict(Json& report, const std::string& property = "c1") {
  for (Json& n : report["schemes"][0]["neighborhoods"])
    if (n["kind"] == "vertex" && n["n"] == 5)
      for (Json& v : n["verdicts"])
        if (v["property"] == property) return v;
  throw std::runtime_error("no verdict on " + property);
}

/// @param analyse_masks  takes a second, and is for what is changed in regular parts
std::string findings(const Json& report, bool analyse_masks = false) {
  std::string all;
  for (const std::string& f : verify_report(report.dump(), {.analyse_masks = analyse_masks}).findings) all += f + "\n";
  return all;
}

TEST(VerifyReport, SeesSoundOnesAgain) {
  const ReportVerification found = verify_report(good().dump());
  EXPECT_TRUE(found.findings.empty()) << found.findings[0];
  EXPECT_EQ(found.kind, "schemes");
  EXPECT_EQ(found.seen_again, 2);
  EXPECT_EQ(found.seen_with_scheme, 2);
  EXPECT_EQ(found.by_nets, 0);
  EXPECT_GT(found.decided, 10);
  EXPECT_GE(found.verdicts, found.seen_again + found.decided);
}

/// Readers do (report_format.md); `statements`, which earlier builds wrote, is such a key, whatever is in it.
TEST(VerifyReport, IgnoresKeysThatItDoesNotKnow) {
  for (const Json& statements : {Json(), Json("words"), Json{{{"says", "C^1"}, {"verdict", "refuted"}}}}) {
    Json old = good();
    old["statements"] = statements;
    EXPECT_EQ(findings(old), "") << statements;
  }
}

TEST(VerifyReport, TakesNoOpenHypothesisOfAllValences) {
  Json bad = good();
  Json& all = bad["schemes"][0]["all_valences"];
  ASSERT_EQ(all["verdict"], "proved");
  all["hypotheses"][0]["holds"] = nullptr;
  expect_parts(findings(bad), {"loop, all valences, c1-all-valences: ", "n = 3"});
}

TEST(VerifyReport, TellsWhereAWitnessIsTamperedWith) {
  Json bad = good();
  verdict(bad)["witness"]["rows"][0]["weights"][0][3] = "1/3";
  expect_parts(findings(bad), {"loop, vertex 5, c1: "});
  bad = good();
  verdict(bad)["witness"]["leaves"].erase(0);
  expect_parts(findings(bad), {"loop, vertex 5, c1: "});
  bad = good();
  verdict(bad)["witness"] = "trust me";
  expect_parts(findings(bad), {"loop, vertex 5, c1: "});
}

TEST(VerifyReport, WantsTheWitnessOfTheSchemeAndTheNeighborhood) {
  Json bad = good();
  verdict(bad)["witness"] = good()["schemes"][0]["neighborhoods"][0]["verdicts"][2]["witness"];
  ASSERT_TRUE(verdict(bad)["witness"].is_object());
  expect_parts(findings(bad), {"loop, vertex 5, c1: ", "n = 3"});
  // Everywhere another name: the witnesses are sound, but not of that scheme.
  std::string renamed = good().dump();
  for (size_t at = 0; (at = renamed.find("\"loop\"", at)) != std::string::npos;)
    renamed.replace(at, 6, "\"loop-warren\"");
  const ReportVerification found = verify_report(renamed);
  // Both have the same weights at valence 3.
  std::string all;
  for (const std::string& finding : found.findings) all += finding + "\n";
  expect_parts(all, {"loop-warren, vertex 5, c1: ", "its row for the point at (0, 0)"});
  EXPECT_EQ(all.find("vertex 3"), std::string::npos) << all;
  // A scheme that nobody knows is believed to have these rows.
  std::string own = good().dump();
  for (size_t at = 0; (at = own.find("\"loop\"", at)) != std::string::npos;) own.replace(at, 6, "\"mine\"");
  EXPECT_TRUE(verify_report(own).findings.empty());
  EXPECT_EQ(verify_report(own).seen_with_scheme, 0);
}

TEST(VerifyReport, FindsVerdictsThatAreNotProved) {
  Json bad = good();
  verdict(bad)["witness"] = nullptr;
  expect_parts(findings(bad), {"loop, vertex 5, c1: said to be proved, without a witness"});
  bad = good();
  verdict(bad)["verdict"] = "disproved";
  expect_parts(findings(bad), {"loop, vertex 5, c1: ", "the verdict is disproved", "summary"});
  bad = good();
  verdict(bad, "c2")["verdict"] = "proved";
  expect_parts(findings(bad), {"loop, vertex 5, c2: said to be proved, although"});
  bad = good();
  verdict(bad)["hypotheses"][0]["by"] = "floating";
  expect_parts(findings(bad), {"loop, vertex 5, c1: ", "by floating numbers"});
  bad = good();
  verdict(bad)["verdict"] = "obvious";
  expect_parts(findings(bad), {"'obvious' is no verdict"});
  bad = good();
  bad["summary"][0]["extraordinary"] = "C^2";
  expect_parts(findings(bad), {"summary, \"loop\": extraordinary is \"C^2\", and the verdicts say \"C^1\""});
  bad = good();
  verdict(bad)["property"] = "c3";
  expect_parts(findings(bad), {"there is no verdict on c1"});
}

/// Doo-Sabin's scheme said to be interpolating, as a scheme of the registry or as one that is not there.
Json said_to_interpolate(const std::string& name = "doo-sabin") {
  static const Json made = report::schemes_report({report::reported_scheme("doo-sabin")}, {.valences = {3, 4}});
  Json bad = made;
  Json& scheme = bad["schemes"][0];
  scheme["interpolates"] = true;
  scheme["claims"].push_back({{"claim", "interpolates"},
                              {"claimed", true},
                              {"found", true},
                              {"verdict", "proved"},
                              {"because", "every vertex looked at is its own child"}});
  bad["summary"][0]["type"] = "interpolating";
  for (Json* const word : {&scheme["name"], &bad["summary"][0]["scheme"]}) *word = name;
  for (Json& n : scheme["neighborhoods"])
    for (Json& v : n["verdicts"])
      if (v["witness"].is_object()) v["witness"]["scheme"] = name;
  return bad;
}

TEST(VerifyReport, RefusesAProofOfSomethingFalse) {
  for (const char* name : {"doo-sabin", "mine"}) {
    const std::string all = findings(said_to_interpolate(name));
    expect_parts(all, {std::string(name) + ": it is said to be interpolating, and its masks are approximating",
                       "the claim interpolates is said to be \"proved\"", "\"disproved\""});
  }
  // As reports of earlier builds were, without rows.
  Json old = said_to_interpolate();
  for (Json& n : old["schemes"][0]["neighborhoods"]) n.erase("rows");
  expect_parts(findings(old), {"doo-sabin: it is said to be interpolating"});
  // Nothing was looked at.
  Json empty = said_to_interpolate("mine");
  empty["schemes"][0]["neighborhoods"] = Json::array();
  expect_parts(findings(empty), {"no vertex inside was looked at"});
  // The type alone.
  Json type = good();
  type["summary"][0]["type"] = "interpolating";
  expect_parts(findings(type), {"summary, \"loop\": type is \"interpolating\""});
  type["schemes"][0]["interpolates"] = true;
  expect_parts(findings(type), {"loop: it is said to be interpolating"});
  for (Json& n : type["schemes"][0]["neighborhoods"]) n["rows"]["keeps_centre"] = true;
  expect_parts(findings(type), {"loop, vertex 5: its rows are said to be"});
}

TEST(VerifyReport, LooksAtRegularPartsAgain) {
  Json bad = good();
  Json& regular = bad["schemes"][0]["regular"];
  regular["smoothness"]["continuity"] = 3;
  expect_parts(findings(bad, true), {"loop, regular: continuity is 3, and the mask gives 2"});
  bad = good();
  for (Json& v : bad["schemes"][0]["regular"]["verdicts"])
    if (v["says"] == "C^2") v["says"] = "C^3";
  expect_parts(findings(bad, true), {"loop, regular: verdicts is"});
  bad = good();
  bad["schemes"][0]["regular"]["mask"][0]["exact"] = "1/5";
  expect_parts(findings(bad), {"loop, regular: its mask is not that of the scheme"});
  bad = good();
  bad["schemes"][0]["regular"]["mask"][0]["exact"] = "1/0";
  expect_parts(findings(bad), {"loop, regular: '1/0' is no ratio"});
  bad = good();
  bad["schemes"][0]["claims"][0]["claimed"] = 5;
  expect_parts(findings(bad), {"the claim regular is said to be \"proved\""});
}

TEST(VerifyReport, WantsHypothesesOfProofsAndDisproofs) {
  Json bad = good();
  verdict(bad, "affine-invariance")["hypotheses"] = Json::array();
  expect_parts(findings(bad), {"affine-invariance: said to be proved, without a hypothesis"});
  bad = good();
  verdict(bad, "convergence")["verdict"] = "disproved";
  expect_parts(findings(bad), {"convergence: said to be disproved, although no hypothesis is known to fail"});
  bad = good();
  bad["schemes"] = bad["summary"] = Json::array();
  expect_parts(findings(bad), {"there are none, so nothing was looked at"});
}

/// A verdict turned, with a hypothesis that is said to fail, so that it does not contradict itself.
Json& disproved(Json& report, const std::string& property) {
  Json& turned = verdict(report, property);
  turned["verdict"] = "disproved";
  turned["hypotheses"][0]["holds"] = false;
  turned["hypotheses"][0]["by"] = "exact";
  if (turned.contains("witness")) turned["witness"] = nullptr;
  return turned;
}

TEST(VerifyReport, TakesSpectraAgain) {
  Json bad = good();
  disproved(bad, "convergence");
  expect_parts(findings(bad), {"loop, vertex 5: convergence is said to be \"disproved\", and the spectrum of the masks",
                               "\"proved\""});
  bad = good();
  disproved(bad, "c1");
  expect_parts(
      findings(bad),
      {"loop, vertex 5: c1 is said to be \"disproved\", and the characteristic map of the masks", "\"proved\""});
  bad = good();
  verdict(bad, "convergence")["property"] = "confidence";
  expect_parts(findings(bad), {"loop, vertex 5: there is no verdict on convergence"});
  // At valence 3 butterfly's leading eigenvalue has multiplicity three.
  bad = report::schemes_report({report::reported_scheme("butterfly")}, {.valences = {3}});
  EXPECT_EQ(findings(bad), "");
  for (Json& n : bad["schemes"][0]["neighborhoods"])
    for (Json& v : n["verdicts"])
      if (n["kind"] == "vertex" && v["property"] == "c1") {
        EXPECT_EQ(v["verdict"], "disproved");
        v["verdict"] = "unknown";
      }
  expect_parts(findings(bad), {"butterfly, vertex 3: c1 is said to be \"unknown\", and the spectrum of the masks says "
                               "\"disproved\""});
}

TEST(VerifyReport, LooksAtCurvesAgain) {
  Json report = report::report_head("schemes");
  report["schemes"] = {report::curve_scheme_json("four-point"), report::curve_scheme_json("chaikin"),
                       report::curve_scheme_json("hermite-merrien"), report::curve_scheme_json("trigonometric-cubic"),
                       report::mask_scheme_json("0 1 2 1 /2")};
  report["summary"] = Json::array();
  for (const Json& scheme : report["schemes"]) report["summary"].push_back(report::summary_row(scheme));
  EXPECT_EQ(findings(report), "");
  for (size_t s = 0; s < 5; ++s) {
    Json bad = report;
    Json& type = bad["schemes"][s]["interpolates"];
    type = !type.get<bool>();
    bad["summary"][s] = report::summary_row(bad["schemes"][s]);
    expect_parts(findings(bad), {report["schemes"][s]["name"].get<std::string>() + ", regular: it is said to be"});
  }
  Json bad = report;
  bad["schemes"][0]["regular"]["mask"][0]["exact"] = "1/3";
  expect_parts(findings(bad), {"four-point, regular: its mask is not that of the scheme"});
  // Joints of the pieces of a curve.
  Json pieces = report::report_head("curve");
  pieces["curve"] = report::curve_json(read_bezier_curve("piece,x,y\n0,0,0\n0,1,0\n1,1,0\n1,1,1\n"));
  EXPECT_EQ(findings(pieces), "");
  pieces["curve"]["knots"][0]["g"] = 1;
  expect_parts(findings(pieces), {"curve: joint 0: g is 1, and the pieces give 0"});
}

void collect(Json& j, std::vector<Json*>& all) {
  if (j.is_structured())
    for (Json& child : j) collect(child, all);
  else
    all.push_back(&j);
}

/// No value, however odd, is accepted in a witness or ends the program.
TEST(VerifyReport, FindsAnyValueThatIsReplaced) {
  const std::vector<Json> odd{nullptr,
                              -1,
                              1e300,
                              "",
                              "x",
                              "[5",
                              "1/0",
                              "[0] 1",
                              true,
                              "999/7",
                              Json::array(),
                              "[7] 1 2 3 4 5 6 7 8",
                              "[1000000] 1 1",
                              Json::object()};
  std::mt19937 random(7);
  for (int trial = 0; trial < 30; ++trial) {
    Json bad = good();
    std::vector<Json*> values;
    collect(verdict(bad)["witness"], values);
    Json& value = *values[random() % values.size()];
    const Json before = value;
    value = odd[random() % odd.size()];
    if (value == before) continue;
    EXPECT_NE(findings(bad), "") << before << " became " << value;
  }
}

TEST(VerifyReport, RefusesWhatIsNoReport) {
  const auto refused = [](const std::string& text, std::string_view part) {
    try {
      verify_report(text);
      FAIL() << text.substr(0, 60) << " was taken";
    } catch (const FormatError& error) {
      expect_parts(error.what(), {part});
    }
  };
  const std::string head = R"({"format": "sublimit-report", "version": )";
  refused("", "not JSON");
  refused("{", "not JSON");
  refused("[]", "no report");
  refused("{}", "no report");
  refused(head + "2, \"kind\": \"schemes\"}", "version 2");
  refused(head + "1, \"kind\": \"poem\"}", "kind \"poem\"");
  refused(head + "1, \"kind\": \"schemes\"}", "missing");
  refused(head + "1, \"kind\": \"schemes\", \"schemes\": [1], \"summary\": []}", "missing");
  refused(std::string(100000, '['), "nested too deep");
  EXPECT_TRUE(verify_report(head + "1, \"kind\": \"mesh\"}").findings.empty());
}

TEST(VerifyReport, StatusOfTheProgram) {
  const TemporaryDirectory directory;
  const auto status = [&](const std::string& text) {
    return sublimit({"verify", directory.write("r.json", text).string()});
  };
  EXPECT_EQ(status(good().dump()).status, 0);
  Json bad = good();
  verdict(bad)["witness"] = nullptr;
  const Outcome tampered = status(bad.dump());
  EXPECT_EQ(tampered.status, 1);
  expect_parts(tampered.out, {"r.json: loop, vertex 5, c1: said to be proved, without a witness"});
  EXPECT_EQ(tampered.err, "");
  EXPECT_EQ(status(said_to_interpolate().dump()).status, 1);
  expect_failure(status("{"), 3, {"r.json", "not JSON"});
  expect_failure(status("{}"), 3, {"r.json", "no report"});
  expect_failure(sublimit({"verify", (directory / "none.json").string()}), 3, {"none.json", "No such file"});
}

}  // namespace
}  // namespace sublimit::testing
