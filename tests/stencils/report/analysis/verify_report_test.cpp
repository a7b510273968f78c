// SPDX-License-Identifier: Apache-2.0
// Reports are believed as far as their witnesses go: whatever is changed in one must be found, and told where it is.
#include "sublimit/report/analysis/verify_report.h"

#include <gtest/gtest.h>

#include <random>

#include "stencils/cli_program.h"
#include "sublimit/base/error.h"
#include "sublimit/files/numbers.h"
#include "sublimit/report/analysis/scheme_report.h"

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

std::string findings(const Json& report) {
  std::string all;
  for (const std::string& f : verify_report(report.dump()).findings) all += f + "\n";
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
  ASSERT_EQ(found.findings.size(), 1u);  // both have the same weights at valence 3
  expect_parts(found.findings[0], {"loop-warren, vertex 5, c1: ", "its row for the point at (0, 0)"});
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
  EXPECT_TRUE(verify_report(head + "1, \"kind\": \"curve\"}").findings.empty());
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
  expect_failure(status("{"), 3, {"r.json", "not JSON"});
  expect_failure(status("{}"), 3, {"r.json", "no report"});
  expect_failure(sublimit({"verify", (directory / "none.json").string()}), 3, {"none.json", "No such file"});
}

}  // namespace
}  // namespace sublimit::testing
