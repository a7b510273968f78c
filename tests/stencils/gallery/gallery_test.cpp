// SPDX-License-Identifier: Apache-2.0
#include "sublimit/stencils/gallery/gallery.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "stencils/browser.h"
#include "stencils/cli_program.h"
#include "sublimit/curves/schemes/curve_schemes.h"
#include "sublimit/geometric/geometric_schemes.h"
#include "sublimit/schemes/schemes.h"
#include "support/expect_error.h"

namespace sublimit::testing {
namespace {

using Json = nlohmann::json;

TEST(Gallery, RejectsOptionsOutsideTheirRange) {
  EXPECT_THROW(make_gallery({.levels = -1}), InvalidParameter);
  EXPECT_THROW(make_gallery({.faces = 10}), InvalidParameter);
}

TEST(Gallery, FilesAreWrittenAllOrNone) {
  const TemporaryDirectory directory;
  std::filesystem::create_directory(directory / "b.svg");
  EXPECT_THROW(write_gallery(directory.path().string(), {{"a.svg", "a"}, {"b.svg", "b"}}), IoError);
  EXPECT_EQ(directory.num_files(), 1);
  write_gallery(directory.path().string(), {{"a.svg", "a"}, {"c.svg", "c"}});
  EXPECT_EQ(directory.num_files(), 3);
  EXPECT_EQ(read_file(directory / "c.svg"), "c");
}

/// What the page carries for its script.
Json carried(const std::string& html) {
  const std::string mark = "id=\"gallery\">";
  const size_t begin = html.find(mark) + mark.size();
  return Json::parse(html.substr(begin, html.find("</script>", begin) - begin));
}

/// Every file that the page shows or points to.
std::vector<std::string> shown(std::string html) {
  std::vector<std::string> files;
  const Json data = carried(html);
  for (const Json& section : data["sections"])
    for (const Json& row : section["rows"]) files.push_back(row["picture"]);
  html.erase(html.find("<script"));
  for (const std::string attribute : {"src=\"", "href=\""})
    for (size_t at = html.find(attribute); at != std::string::npos; at = html.find(attribute, at + 1)) {
      const size_t begin = at + attribute.size();
      const std::string file = html.substr(begin, html.find('"', begin) - begin);
      if (!file.starts_with("#")) files.push_back(file);
    }
  return files;
}

TEST(CliGallery, ShowsEverySchemeOnEveryCageAndPolygon) {
  const TemporaryDirectory directory;
  const std::filesystem::path gallery = directory / "a" / "gallery";
  const std::vector<std::string> arguments{"schemes", "--gallery", gallery.string(), "--gallery-faces", "200"};
  const std::string says = expect_done(sublimit(arguments)).out;

  const std::string html = read_file(gallery / "index.html");
  std::multiset<std::pair<std::string, std::string>> rows;  // names and pictures
  const Json data = carried(html);
  for (const Json& section : data["sections"])
    for (const Json& row : section["rows"]) {
      rows.emplace(row["name"], row["picture"]);
      EXPECT_NE(row["source"], "");
      EXPECT_GE(row["numbers"].size(), 2u);
    }
  EXPECT_GE(data["patches"].size(), 22u);
  EXPECT_EQ(data["stitched"].size(), 2u);
  const auto count_of_rows = [&](const std::string& scheme) {
    return std::ranges::count_if(rows, [&](const auto& row) { return row.first == scheme; });
  };
  std::ptrdiff_t surfaces = 0;
  for (const Scheme<double>& scheme : all_schemes()) {
    SCOPED_TRACE(scheme.name);
    const std::ptrdiff_t cages = scheme.face_size() == 3 ? 3 : 4;
    EXPECT_EQ(count_of_rows(scheme.name), cages);
    for (const char* cage : {"cube-tetrahedral", "cube-irregular", "tetrahedron"})
      EXPECT_EQ(rows.count({scheme.name, scheme.name + "-" + cage + ".svg"}), 1u) << cage;
    surfaces += cages;
  }
  std::vector<std::string> curves;
  for (const CurveScheme<double>& scheme : all_curve_schemes()) curves.push_back(scheme.name);
  for (const GeometricCurveScheme& scheme : all_geometric_schemes()) curves.push_back(scheme.name);
  for (const std::string& scheme : curves) {
    SCOPED_TRACE(scheme);
    EXPECT_EQ(count_of_rows(scheme), 2);
    for (const char* polygon : {"open", "closed"}) {
      EXPECT_EQ(rows.count({scheme, scheme + "-" + polygon + ".svg"}), 1u) << polygon;
      EXPECT_EQ(count_of(read_file(gallery / (scheme + "-" + polygon + ".svg")), ">level "), 4u) << polygon;
    }
  }
  const std::vector<std::string> files = shown(html);
  EXPECT_GE(std::ssize(files), surfaces + 2);
  for (const std::string& file : files) {
    EXPECT_EQ(file.find('/'), std::string::npos) << file << " is not beside the page";
    const std::string text = read_file(gallery / file);
    EXPECT_GT(text.size(), 1000u) << file;
    if (!file.ends_with(".svg")) continue;
    EXPECT_TRUE(text.starts_with("<svg") && text.ends_with("</svg>\n")) << file;
    EXPECT_EQ(text.find("nan"), std::string::npos) << file;
  }
  for (const char* file : {"overview.svg", "patches.svg"}) {
    EXPECT_EQ(count_of(html, "src=\"" + std::string(file) + "\""), 1u) << file;
    EXPECT_LT(read_file(gallery / file).size(), 400'000u) << file;  // pages show them
  }
  EXPECT_EQ(count_of(html, "href=\"patches.json\""), 1u);
  const auto pictures = std::ranges::count_if(files, [](const std::string& file) { return file.ends_with(".svg"); });
  expect_parts(says, {std::to_string(pictures) + " pictures", "index.html"});

  const Json json = Json::parse(read_file(gallery / "measures.json"));
  EXPECT_EQ(std::ssize(json["surfaces"]), surfaces);
  for (const Json& surface : json["surfaces"]) {
    const bool bilinear = surface["scheme"] == "bilinear";
    EXPECT_EQ(surface["mean_distance"].get<double>() < 1e-12, bilinear) << surface;
    EXPECT_EQ(std::abs(surface["volume_ratio"].get<double>() - 1) < 1e-12, bilinear) << surface;
    if (surface["cage"] == "cube" || surface["cage"] == "tetrahedron") {
      constexpr double mirrored_sums = 1e-12;  // sums in another order
      EXPECT_LT(surface["symmetry_defect"].get<double>(), mirrored_sums) << surface;
    }
    EXPECT_GT(surface["bending_energy"][2]["energy"].get<double>(), .98) << surface;  // a sphere has least
  }

  // The same bytes with one thread; and nothing but the list with --json.
  std::vector<std::string> again = arguments;
  again[2] = (directory / "again").string();
  again.insert(again.end(), {"--threads", "1", "--json"});
  EXPECT_EQ(Json::parse(expect_done(sublimit(again)).out).size(),
            all_schemes().size() + all_curve_schemes().size() + all_geometric_schemes().size() +
                all_geometric_schemes<CurvatureMesh>().size() + all_geometric_schemes<NormalMesh>().size());
  EXPECT_EQ(read_file(directory / "again" / "index.html"), html);
  for (const std::string& file : files)
    EXPECT_EQ(read_file(directory / "again" / file), read_file(gallery / file)) << file;
}

TEST(CliGallery, PageShowsItsDataInChromium) {
  Browser browser;
  SUBLIMIT_NEEDS_BROWSER;
  const std::string page = make_gallery({.levels = 0, .faces = 200}).back().text;
  const Json data = carried(page);
  const std::string count = R"(const count = q => document.querySelectorAll(q).length;
    const links = [...document.querySelectorAll('nav a')].every(a => document.getElementById(a.getAttribute('href').slice(1)));
    parent.postMessage(['h3', '.row img[alt]', '#patch-rows tr', '#stitched-rows tr', 'a[href="stitched.html"]']
      .map(count).join(' ') + ' ' + links + ' ' + count('nav a') + ';', '*');)";
  browser.add("gallery", replaced(page, "</body>", "<script>" + count + "</script></body>"));
  browser.add("narrow", with_script(replaced(page, "<img ", "<img width=\"900\" "), "measure_page.js"), 400);
  const std::string found = browser.read();
  size_t rows = 0;
  for (const Json& section : data["sections"]) rows += section["rows"].size();
  const std::string all = std::to_string(rows);
  expect_parts(found, {all + " " + all + " " + std::to_string(data["patches"].size()) + " 2 0 true " +
                           std::to_string(data["sections"].size() + 3) + ";",
                       "measured narrow.html: 0 wrong"});
}

TEST(CliGallery, UnwritablePlacesAreToldBeforeWorkStarts) {
  const TemporaryDirectory directory;
  directory.write("file", "");
  for (const std::string place : {"file", "file/gallery"})
    expect_failure(sublimit({"schemes", "--gallery", (directory / place).string()}), 3, {place, "directory"});
  std::filesystem::create_directories(directory / "taken" / "index.html");
  expect_failure(sublimit({"schemes", "--gallery", (directory / "taken").string()}), 3,
                 {"index.html", "is a directory"});
  EXPECT_EQ(directory.num_files(), 2);
  expect_failure(sublimit({"schemes", "--gallery-faces", "300"}), 2, {"--gallery"});
  expect_failure(sublimit({"schemes", "--gallery", "x", "--gallery-faces", "3"}), 2, {"200"});
}

}  // namespace
}  // namespace sublimit::testing
