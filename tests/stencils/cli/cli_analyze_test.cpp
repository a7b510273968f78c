// SPDX-License-Identifier: Apache-2.0
// `sublimit analyze`: reports of schemes, masks, sweeps, curves and meshes, as files and on the terminal.
#include <gtest/gtest.h>

#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "meshes/meshes.h"
#include "stencils/cli_program.h"
#include "stencils/summary_rows.h"
#include "sublimit/certificates/numbers/algebraic.h"
#include "sublimit/io/detail/obj.h"

namespace sublimit::testing {
namespace {

using Json = nlohmann::ordered_json;

std::vector<std::string> keys(const Json& object) {
  std::vector<std::string> all;
  for (const auto& [key, value] : object.items()) all.push_back(key);
  return all;
}

/// Runs `analyze` with --json added; the report.
Json analyzed(std::vector<std::string> arguments, int status = 0) {
  const TemporaryDirectory directory;
  const std::string json = (directory / "report.json").string();
  arguments.insert(arguments.begin(), "analyze");
  arguments.insert(arguments.end(), {"--json", json});
  const Outcome outcome = sublimit(arguments);
  EXPECT_EQ(outcome.status, status) << outcome.out << outcome.err;
  return Json::parse(read_file(json));
}

/// The report of one scheme, valences 3 to 5, made once.
const Json& report_of(const std::string& scheme) {
  static std::map<std::string, Json> made;
  Json& report = made[scheme];
  if (report.is_null()) report = analyzed({"-s", scheme, "--valence", "3-5"});
  return report;
}

const Json& verdict(const Json& neighborhood, const std::string& property) {
  for (const Json& v : neighborhood["verdicts"])
    if (v["property"] == property) return v;
  throw std::runtime_error("no verdict on " + property);
}

TEST(CliAnalyze, ReportHasEveryKeyOfTheFormatInOrder) {
  using Keys = std::vector<std::string>;
  const Json& report = report_of("catmull-clark");
  EXPECT_EQ(keys(report), (Keys{"format", "version", "program", "kind", "schemes", "summary"}));
  EXPECT_EQ(report["format"], "sublimit-report");
  EXPECT_EQ(report["version"], 1);
  const Json& scheme = report["schemes"][0];
  EXPECT_EQ(keys(scheme), (Keys{"name", "kind", "options", "source", "mesh", "split", "interpolates", "claims",
                                "regular", "neighborhoods", "all_valences", "knot_intervals"}));
  EXPECT_EQ(keys(scheme["claims"][0]), (Keys{"claim", "claimed", "found", "verdict", "because"}));
  EXPECT_EQ(keys(scheme["regular"]),
            (Keys{"dilation", "mask", "unit", "grid", "support", "smoothness", "norms", "joint_spectral_radius",
                  "degrees", "operations", "basis", "criteria", "verdicts"}));
  EXPECT_EQ(keys(report["summary"][0]), (Keys{"scheme", "type", "mesh", "regular", "extraordinary", "regular_verdict",
                                              "extraordinary_verdict", "valences", "notes"}));
  std::map<std::string, int> kinds;
  for (const Json& n : scheme["neighborhoods"]) {
    ++kinds[n["kind"]];
    const Keys head{"kind", "n", "points", "labels", "rows", "spectrum", "lambda", "mu", "ratio", "mu_blocks", "masks"};
    const Keys tail{"characteristic_map", "surface", "normals", "verdicts"};
    Keys expected = head;
    if (n["kind"] == "crease") expected.insert(expected.begin() + 2, "same_as");
    if (n["kind"] == "vertex") expected.emplace_back("eigenfunctions");
    expected.insert(expected.end(), tail.begin(), tail.end());
    EXPECT_EQ(keys(n), expected) << n["kind"] << n["n"];
    EXPECT_EQ(keys(n["spectrum"][0]), (Keys{"block", "value", "modulus", "enclosure", "exact", "copies", "multiplicity",
                                            "geometric", "jordan"}));
    EXPECT_EQ(keys(n["masks"]), (Keys{"position", "tangent1", "tangent2", "second"}));
    for (const Json& v : n["verdicts"]) {
      Keys own = keys(v);
      for (const char* finding : {"curvature", "shapes", "p"}) std::erase(own, finding);
      EXPECT_EQ(own, (Keys{"property", "says", "verdict", "theorem", "hypotheses", "because", "witness"}));
      for (const Json& h : v["hypotheses"]) EXPECT_EQ(keys(h), (Keys{"says", "holds", "by", "value"}));
    }
  }
  EXPECT_EQ(kinds["vertex"], 3);
  EXPECT_GT(kinds["border"], 0);
  EXPECT_GT(kinds["corner"], 0);
  EXPECT_GT(kinds["crease"], 0);
  EXPECT_GT(kinds["dart"], 0);
}

TEST(CliAnalyze, ProvesC1AndVerifySeesItAgain) {
  for (const char* name : {"catmull-clark", "loop"}) {
    const Json& report = report_of(name);
    int vertices = 0;
    for (const Json& n : report["schemes"][0]["neighborhoods"]) {
      if (n["kind"] != "vertex") continue;
      ++vertices;
      EXPECT_EQ(verdict(n, "c1")["verdict"], "proved") << name << n["n"];
      EXPECT_TRUE(verdict(n, "c1")["witness"].is_object());
    }
    EXPECT_EQ(vertices, 3);
    EXPECT_EQ(report["summary"][0]["extraordinary"], "C^1");
    const TemporaryDirectory directory;
    const std::string file = directory.write("report.JSON", report.dump()).string();
    expect_parts(expect_done(sublimit({"verify", file})).out,
                 {"report.JSON: sound", "3 of them proofs with a witness", "3 on the masks of the scheme's own file"});
    EXPECT_EQ(expect_done(sublimit({"verify", file, "--quiet"})).out, "");
  }
}

TEST(CliAnalyze, SameBytesForAnyNumberOfThreads) {
  const TemporaryDirectory directory;
  std::vector<std::string> pages, reports;
  for (const char* threads : {"1", "4", "4"}) {
    const std::string page = (directory / "r.html").string(), json = (directory / "r.json").string();
    expect_done(
        sublimit({"analyze", "-s", "loop", "--valence", "5", "--threads", threads, "-o", page, "--json", json}));
    pages.push_back(read_file(page));
    reports.push_back(read_file(json));
  }
  for (size_t i = 1; i < pages.size(); ++i) {
    EXPECT_EQ(pages[i], pages[0]);
    EXPECT_EQ(reports[i], reports[0]);
  }
}

TEST(CliAnalyze, StatusTellsWhetherClaimsHold) {
  const Outcome wrong = sublimit({"analyze", "-s", "loop", "--valence", "3", "--claim", "extraordinary=2"});
  EXPECT_EQ(wrong.status, 1);
  expect_parts(wrong.out, {"the claim extraordinary = 2 is disproved", "disproved at 3"});
  expect_done(sublimit({"analyze", "-s", "loop", "--valence", "3", "--claim", "extraordinary=1"}));
  EXPECT_EQ(sublimit({"analyze", "-s", "loop", "--valence", "3", "--claim", "interpolates=yes"}).status, 1);
  EXPECT_EQ(sublimit({"analyze", "-s", "loop", "--valence", "3", "--claim", "generates=4"}).status, 1);
  const Outcome dual = sublimit({"analyze", "-s", "doo-sabin", "--valence", "3", "--claim", "interpolates=yes"});
  EXPECT_EQ(dual.status, 1);
  expect_parts(dual.out, {"approximating", "the claim interpolates = true is disproved: no vertex has a child vertex"});
}

TEST(CliAnalyze, SaysOnlyWhatIsAskedFor) {
  EXPECT_EQ(expect_done(sublimit({"analyze", "-s", "loop", "--valence", "3", "--quiet"})).out, "");
  EXPECT_EQ(expect_done(sublimit({"analyze", "--mask", "1 2 1 /2", "--quiet"})).out, "");
  expect_parts(expect_done(sublimit({"analyze", "--help"})).out,
               {"Examples:", "sublimit analyze -s catmull-clark -o report.html", "--sweep",
                "  1   a claim of the scheme is disproved"});
  expect_parts(expect_done(sublimit({"verify", "--help"})).out, {"sublimit verify report.json", "witness"});
}

TEST(CliAnalyze, SummaryNamesTheValencesOfEachVerdict) {
  const TemporaryDirectory directory;
  const std::string json = (directory / "r.json").string();
  const Outcome outcome = expect_done(sublimit({"analyze", "-s", "butterfly", "--valence", "3-4,8", "--json", json}));
  expect_parts(outcome.out, {"C^1 (proved) at valence 4; C^1 disproved at valence 3, 8\n"});
  expect_rows_name_their_valences(Json::parse(read_file(json)));
}

TEST(CliAnalyze, ExportsExactMatricesAndMaps) {
  const TemporaryDirectory directory;
  const std::string out = (directory / "a" / "b").string();
  expect_done(sublimit({"analyze", "-s", "loop", "--valence", "5", "--export", out}));
  std::istringstream text(read_file(out + "/loop-vertex-5.matrix.txt"));
  std::string line;
  size_t labels = 0;
  std::map<int, Algebraic> sums;
  while (std::getline(text, line)) {
    if (line.starts_with("# labels")) labels = std::stoul(line.substr(9));
    if (line.starts_with("# entries")) break;
  }
  while (std::getline(text, line)) {
    std::istringstream words(line);
    int row = 0, column = 0;
    ASSERT_TRUE(words >> row >> column) << line;
    ASSERT_LT(size_t(column), labels);
    std::getline(words, line);
    sums[row] += Algebraic::parse(line);
  }
  EXPECT_EQ(sums.size(), labels);
  EXPECT_GE(labels, 6u);
  for (const auto& [row, sum] : sums) EXPECT_TRUE(sum.is_one()) << row;
  expect_parts(expect_done(sublimit({"info", out + "/loop-vertex-5.map.obj"})).out, {"5 x 1", "no faults"});
}

TEST(CliAnalyze, TypedMasks) {
  const Json good = analyzed({"--mask", "1 4 6 4 1 /8"});
  EXPECT_EQ(good["schemes"][0]["regular"]["smoothness"]["continuity"], 2);
  EXPECT_EQ(good["summary"][0]["regular"], "C^2");
  EXPECT_EQ(good["summary"][0]["regular_verdict"], "proved");
  const Json bad = analyzed({"--mask", "1 4 6 4 1"});
  EXPECT_TRUE(bad["schemes"][0]["regular"]["smoothness"]["continuity"].is_null());
  EXPECT_EQ(verdict(bad["schemes"][0]["regular"], "affine-invariance")["verdict"], "disproved");
  expect_parts(sublimit({"analyze", "--mask", "1 4 6 4 1"}).out, {"disproved", "the masks sum to 8 and 8"});
}

TEST(CliAnalyze, Sweeps) {
  const Json report = analyzed({"-s", "four-point", "--sweep", "tension=-1:1:1"});
  EXPECT_EQ(report["kind"], "sweep");
  EXPECT_EQ(report["sweep"]["option"], "tension");
  EXPECT_EQ(report["sweep"]["values"], Json::parse("[-1.0, 0.0, 1.0]"));
  EXPECT_EQ(report["sweep"]["series"][0]["values"], Json::parse("[0, 0, 1]"));  // C^1 at the classical one alone
}

TEST(CliAnalyze, CurvesOfPieces) {
  const TemporaryDirectory directory;
  const std::string head = "piece,x,y\n0,0,0\n0,1,0\n1,1,0\n";
  const auto knot = [&](const std::string& end) {
    return analyzed({directory.write("c.csv", head + end).string()})["curve"]["knots"][0];
  };
  EXPECT_EQ(knot("1,2,0\n")["c"], 1);
  EXPECT_EQ(knot("1,3,0\n")["c"], 0);
  EXPECT_EQ(knot("1,3,0\n")["g"], 1);
  EXPECT_EQ(knot("1,3,0\n")["verdict"], "C^0, G^1 at least") << "it is a line";
  EXPECT_EQ(knot("1,0.5,0\n")["g"], 0);  // it turns back
}

TEST(CliAnalyze, SeamsOfMeshesAreJudgedByTolerances) {
  const TemporaryDirectory directory;
  write_obj(directory / "mesh.obj", cube());
  const std::string mesh = (directory / "mesh.obj").string();
  const Json report = analyzed({mesh, "-s", "catmull-clark", "--tolerance", "g1=0.1deg"});
  EXPECT_EQ(report["mesh"]["file"], "mesh.obj");
  EXPECT_EQ(report["mesh"]["seams"]["within_tolerance"], true);
  EXPECT_EQ(analyzed({mesh, "-s", "catmull-clark", "--tolerance", "g2=0.1%"}, 1)["mesh"]["seams"]["within_tolerance"],
            false);
  const Outcome beyond = sublimit({"analyze", mesh, "-s", "catmull-clark", "--tolerance", "g2=0.1%"});
  EXPECT_EQ(beyond.status, 1);
  expect_parts(beyond.out, {"beyond the tolerance: g2", "at ("});
}

}  // namespace
}  // namespace sublimit::testing
