// SPDX-License-Identifier: Apache-2.0
#include "sublimit/report/page/page.h"

#include <gtest/gtest.h>

#include <functional>
#include <regex>
#include <string>

#include "stencils/markup.h"
#include "stencils/report_sample.h"
#include "sublimit/base/error.h"
#include "support/expect_error.h"

namespace sublimit::testing {
namespace {

using Json = nlohmann::ordered_json;

/// Every kind of report, with few valences: what holds for all pages.
const std::vector<std::pair<std::string, Json>>& reports() {
  static const std::vector<std::pair<std::string, Json>> all = {
      {"schemes", sample_schemes(3, 5)}, {"sweep", sample_sweep()}, {"curve", sample_curve()}, {"mesh", sample_mesh()}};
  return all;
}

/// Pages are expensive: each is drawn once.
const std::string& page_of(const std::string& kind) {
  static std::map<std::string, std::string> pages;
  const auto [found, fresh] = pages.try_emplace(kind);
  if (fresh)
    for (const auto& [name, report] : reports())
      if (name == kind) found->second = report_page(report);
  return found->second;
}

std::size_t count(const std::string& text, const std::string& word) {
  std::size_t found = 0;
  for (std::size_t at = 0; (at = text.find(word, at)) != std::string::npos; at += word.size()) ++found;
  return found;
}

/// Applies a change to every object of a report, the innermost first.
void for_each_object(Json& value, const std::function<void(Json&)>& change) {
  if (value.is_structured())
    for (Json& part : value) for_each_object(part, change);
  if (value.is_object()) change(value);
}

/// A small report whose page takes little time: no surfaces.
Json light_report() {
  Json report = sample_schemes(5, 5);
  for (Json& scheme : report["schemes"])
    for (Json& n : scheme["neighborhoods"]) n["surface"] = nullptr, n["eigenfunctions"] = nullptr;
  report["schemes"].erase(1);  // the triangles
  report["mesh"] = sample_mesh()["mesh"];
  report["mesh"]["surface"] = nullptr;
  report["curve"] = sample_curve()["curve"];
  report["sweep"] = sample_sweep()["sweep"];
  report["schemes"][0]["regular"]["basis"] = nullptr;
  return report;
}

TEST(ReportPage, IsWellFormedAndItsLinksLeadSomewhere) {
  for (const auto& [kind, report] : reports()) {
    const Markup markup = read_markup(page_of(kind));
    EXPECT_EQ(markup.fault, "") << kind;
    for (const auto& [id, times] : markup.ids) EXPECT_EQ(times, 1) << kind << ": id " << id;
    for (const std::string& link : markup.links)
      EXPECT_TRUE(link.size() > 1 && link[0] == '#' && markup.ids.count(link.substr(1)) == 1) << kind << ": " << link;
    EXPECT_GT(markup.images, 0) << kind;
    EXPECT_EQ(markup.untitled, 0) << kind;
  }
}

TEST(ReportPage, TheReaderOfMarkupSeesFaults) {
  for (const char* wrong : {"<p>", "<p></b>", "<p class=x></p>", "<p>a & b</p>", "<p>1 > 0</p>", "<p a=\"<\"></p>",
                            "</p>", "<p a=\"1\"b=\"2\"></p>"})
    EXPECT_NE(read_markup(wrong).fault, "") << wrong;
  EXPECT_EQ(read_markup("<p class=\"a\">x &amp; y<br>z</p>").fault, "");
}

TEST(ReportPage, NeedsNothingButItself) {
  for (const auto& [kind, report] : reports()) {
    std::string page = page_of(kind);
    const std::string svg = "xmlns=\"http://www.w3.org/2000/svg\"";
    for (std::size_t at = 0; (at = page.find(svg, at)) != std::string::npos;) page.erase(at, svg.size());
    for (const char* word : {"http", "<script", "src=", "url(", "@import", "<link", "<img", "<iframe", " on"})
      EXPECT_EQ(count(page, std::string(word) == " on" ? " onload" : word), 0u) << kind << ": " << word;
  }
}

TEST(ReportPage, EverySchemeHasItsSectionAndItsValences) {
  const Markup markup = read_markup(page_of("schemes"));
  for (const char* id :
       {"summary", "scheme-catmull-clark", "scheme-loop", "scheme-four-point", "scheme-catmull-clark-vertex-3",
        "scheme-catmull-clark-vertex-5", "scheme-loop-border-3", "scheme-loop-corner-4", "scheme-loop-dart-5"})
    EXPECT_EQ(markup.ids.count(id), 1u) << id;
}

TEST(ReportPage, ShowsTheVerdictOnAllValences) {
  SampleJson report = sample_schemes(3, 4);
  EXPECT_NE(report_page(report).find("All valences at once"), std::string::npos);
  for (SampleJson& scheme : report["schemes"]) scheme["all_valences"] = nullptr;
  EXPECT_EQ(report_page(report).find("All valences at once"), std::string::npos);
}

TEST(ReportPage, SameReportSameBytes) {
  EXPECT_EQ(report_page(sample_schemes(3, 5)), page_of("schemes"));
  EXPECT_EQ(report_page(Json::parse(sample_mesh().dump())), page_of("mesh"));
}

TEST(ReportPage, IgnoresKeysThatItDoesNotKnow) {
  const auto surprise = [](Json& o) {
    if (!o.contains("tension")) o["surprise"] = {{"x", 1}};  // there, keys are data
  };
  for (const auto& [kind, original] : reports()) {
    if (kind == "schemes") continue;  // below, with less to draw
    Json report = original;
    for_each_object(report, surprise);
    EXPECT_EQ(report_page(report), page_of(kind)) << kind;
  }
  Json report = light_report();
  const std::string page = report_page(report);
  for_each_object(report, surprise);
  report["statements"] = {{{"where", "a text"}, {"says", "C^1"}, {"verdict", "refuted"}}};  // of earlier builds
  EXPECT_EQ(report_page(report), page);
}

TEST(ReportPage, AnythingMayBeNullOrOfAnotherType) {
  const Json original = light_report();
  std::set<std::string> keys;
  Json copy = original;
  for_each_object(copy, [&](Json& o) {
    for (const auto& [key, value] : o.items()) keys.insert(key);
  });
  EXPECT_GT(keys.size(), 90u);
  for (const std::string& key : keys) {
    if (key == "format" || key == "version") continue;
    for (const Json& other : {Json(), Json("words"), Json::array({1, nullptr})}) {
      Json report = original;
      for_each_object(report, [&](Json& o) {
        if (o.contains(key)) o[key] = other;
      });
      std::string page;
      EXPECT_NO_THROW(page = report_page(report)) << key << " as " << other;
      EXPECT_EQ(read_markup(page).fault, "") << key << " as " << other;
    }
  }
}

TEST(ReportPage, ShowsWhatIsNullAsADash) {
  Json report = light_report();
  const std::size_t before = count(report_page(report), ">–</span>");
  Json& n = report["schemes"][0]["neighborhoods"][0];
  n["lambda"] = n["mu"] = n["ratio"] = nullptr;
  EXPECT_EQ(count(report_page(report), ">–</span>"), before + 4);  // three cells of the table, and the head of the fold
}

TEST(ReportPage, HostileNamesStayNames) {
  const std::string hostile = "</title><script>alert(1)</script>\"' onload=x & <b>\x01";
  Json report = light_report();
  Json& scheme = report["schemes"][0];
  for_each_object(report, [&](Json& o) {
    for (auto& [key, value] : o.items())
      if (value.is_string() && key != "format" && key != "kind" && key != "verdict" && key != "grid") value = hostile;
  });
  scheme["options"] = {{hostile, hostile}};
  report["mesh"]["surface"] = sample_mesh()["mesh"]["surface"];
  for (const char* kind : {"schemes", "<script>"}) {
    report["kind"] = kind;
    const std::string page = report_page(report);
    const Markup markup = read_markup(page);
    EXPECT_EQ(markup.fault, "") << kind;
    EXPECT_EQ(markup.elements.count("script"), 0u) << kind;
    EXPECT_EQ(page.find('\x01'), std::string::npos) << kind;
    for (const auto& [id, times] : markup.ids) EXPECT_EQ(times, 1) << kind << ": id " << id;
  }
}

TEST(ReportPage, RefusesWhatItDoesNotKnow) {
  Json report = sample_curve();
  report["version"] = 2;
  expect_error<FormatError>([&] { report_page(report); }, {"version 2", "version 1"});
  report = sample_curve();
  report["format"] = "something";
  expect_error<FormatError>([&] { report_page(report); }, {"sublimit-report"});
  expect_error<FormatError>([&] { report_page(Json::array()); }, {"report.json"});
}

TEST(ReportPage, StripesOfAMeshComeFromItsNormals) {
  const std::string& page = page_of("mesh");
  EXPECT_EQ(count(page, "<b>Zebra stripes</b>"), 1u);
  EXPECT_EQ(count(page, "<b>Isophotes</b>"), 1u);
  Json without = sample_mesh();
  for_each_object(without, [](Json& object) { object.erase("normals"); });
  const std::string plain = report_page(without);
  EXPECT_EQ(count(plain, "<b>Zebra stripes</b>") + count(plain, "<b>Isophotes</b>"), 0u);
  EXPECT_EQ(count(plain, "<b>The limit surface</b>"), 1u);
}

TEST(ReportPage, StaysSmall) { EXPECT_LT(report_page(sample_schemes(5, 8)).size(), 1'200'000u); }

}  // namespace
}  // namespace sublimit::testing
