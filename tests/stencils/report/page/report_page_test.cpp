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

/// What a page carries: the report with its figures.
Json carried(const std::string& page) {
  const std::string mark = "<script type=\"application/json\" id=\"report\">";
  const std::size_t begin = page.find(mark) + mark.size();
  return Json::parse(page.substr(begin, page.find("</script>", begin) - begin));
}

/// Returns the number of figures, all of which must be well-formed and have titles.
int expect_figures(const Json& value, const std::string& where) {
  int figures = 0;
  if (value.is_object() && value.contains("svg")) {
    const Markup markup = read_markup(value["svg"].get<std::string>());
    EXPECT_EQ(markup.fault, "") << where;
    EXPECT_EQ(markup.images, 1) << where;
    EXPECT_EQ(markup.untitled, 0) << where;
    EXPECT_EQ(markup.elements.count("script"), 0u) << where;
    for (const Json& sign : value.value("legend", Json::array()))
      EXPECT_EQ(read_markup(sign[0].get<std::string>()).fault, "") << where;
    return 1;
  }
  if (value.is_structured())
    for (const Json& part : value) figures += expect_figures(part, where);
  return figures;
}

TEST(ReportPage, IsWellFormedAndCarriesFigures) {
  for (const auto& [kind, report] : reports()) {
    const Markup markup = read_markup(page_of(kind));
    EXPECT_EQ(markup.fault, "") << kind;
    for (const auto& [id, times] : markup.ids) EXPECT_EQ(times, 1) << kind << ": id " << id;
    EXPECT_EQ(markup.elements.at("noscript"), 1) << kind;
    EXPECT_GT(expect_figures(carried(page_of(kind)), kind), 0) << kind;
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
    const std::string svg = "http://www.w3.org/2000/svg";
    for (std::size_t at = 0; (at = page.find(svg, at)) != std::string::npos;) page.erase(at, svg.size());
    for (const char* word :
         {"http", "src=", "url(", "@import", "import(", "fetch", "<link", "<img", "<iframe", " onload"})
      EXPECT_EQ(count(page, word), 0u) << kind << ": " << word;
  }
}

TEST(ReportPage, SameReportSameBytes) {
  EXPECT_EQ(report_page(sample_schemes(3, 5)), page_of("schemes"));
  EXPECT_EQ(report_page(Json::parse(sample_mesh().dump())), page_of("mesh"));
}

/// All figures of a page, one after the other.
Json figures_of(const std::string& page) {
  Json all = Json::array(), report = carried(page);
  for_each_object(report, [&](Json& o) {
    if (o.contains("figures")) all.push_back(o["figures"]);
  });
  return all;
}

// What the page's script makes of such reports is in the test in a browser.
TEST(ReportPage, IgnoresKeysThatItDoesNotKnow) {
  const auto surprise = [](Json& o) {
    if (!o.contains("tension")) o["surprise"] = {{"x", 1}};  // there, keys are data
  };
  for (const auto& [kind, original] : reports()) {
    if (kind == "schemes") continue;  // below, with less to draw
    Json report = original;
    for_each_object(report, surprise);
    EXPECT_EQ(figures_of(report_page(report)), figures_of(page_of(kind))) << kind;
  }
  Json report = light_report();
  const Json figures = figures_of(report_page(report));
  for_each_object(report, surprise);
  for_each_object(report, [](Json& o) { o["figures"] = {{"mask", {{"svg", "<script/>"}}}}; });
  report["statements"] = {{{"where", "a text"}, {"says", "C^1"}, {"verdict", "refuted"}}};  // of earlier builds
  EXPECT_EQ(figures_of(report_page(report)), figures);
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
      expect_figures(carried(page), key + " as " + other.dump());
    }
  }
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
    EXPECT_EQ(markup.elements, read_markup(page_of("curve")).elements) << kind;
    EXPECT_EQ(page.find('\x01'), std::string::npos) << kind;
    EXPECT_GT(expect_figures(carried(page), kind), 0);
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
  const auto figures = [](const Json& report) {
    std::set<std::string> drawn;
    const Json page = carried(report_page(report));
    for (const auto& [key, figure] : page["mesh"]["figures"].items())
      if (!figure.is_null()) drawn.insert(key);
    return drawn;
  };
  EXPECT_EQ(figures(sample_mesh()), (std::set<std::string>{"g1", "isophotes", "surface", "zebra"}));
  Json without = sample_mesh();
  for_each_object(without, [](Json& object) { object.erase("normals"); });
  EXPECT_EQ(figures(without), (std::set<std::string>{"g1", "surface"}));
}

TEST(ReportPage, StaysSmall) { EXPECT_LT(report_page(sample_schemes(5, 8)).size(), 1'200'000u); }

}  // namespace
}  // namespace sublimit::testing
