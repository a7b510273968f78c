// SPDX-License-Identifier: Apache-2.0
#include "sublimit/report/page/page.h"

#include <set>

#include "sublimit/base/detail/parallel_for.h"
#include "sublimit/base/error.h"
#include "sublimit/report/page/sections.h"
#include "sublimit/report/page/style.h"
#include "sublimit/report/page/text.h"
#include "sublimit/report/page/verdicts.h"

namespace sublimit {
namespace page {
namespace {

struct Entry {
  std::string id, words;
};

void check(const Json& report) {
  if (string(at(report, "format")) != "sublimit-report")
    throw FormatError("report page: \"format\" is not \"sublimit-report\"; give it a report.json of sublimit analyze");
  if (whole(at(report, "version")) != 1)
    throw FormatError("report page: version " + at(report, "version").dump() +
                      " of the report is not known; this program reads version 1");
}

std::string title_of(const Json& report) {
  const std::string kind = string(at(report, "kind"));
  const Json& schemes = at(report, "schemes");
  if (kind == "mesh") return "How smooth is the limit of " + string(at(at(report, "mesh"), "file"), "this mesh") + "?";
  if (kind == "curve") return "How smooth is this curve?";
  if (kind == "free-form") return "How smooth is " + string(at(at(report, "free_form"), "file"), "this file") + "?";
  if (kind == "sweep")
    return "How smooth is " + string(at(at(schemes, 0), "name"), "the scheme") + ", by " +
           string(at(at(report, "sweep"), "option"), "option") + "?";
  if (schemes.size() == 1) return "How smooth is " + string(at(at(schemes, 0), "name"), "the scheme") + "?";
  return "How smooth are subdivision schemes?";
}

std::string lead_of(const Json& report) {
  const std::string kind = string(at(report, "kind"));
  if (kind == "mesh")
    return "The limit surface of this control mesh: what its irregular places do to it, how well its patches meet, and "
           "where it is worst.";
  if (kind == "curve") return "How the pieces of the curve meet at its knots.";
  if (kind == "free-form")
    return "How the patches and curves of this file meet: measured, and decided without rounding where the file's numbers "
           "allow it; and what of them is degenerate.";
  if (kind == "sweep") return "Smoothness of the limit as one option of the scheme varies.";
  return "Everything on this page is computed from the masks of the schemes. A verdict is <em>proved</em> or "
         "<em>disproved</em> only where it rests on "
         "exact or enclosed arithmetic and a theorem, both named; what rests on floating-point numbers is called "
         "<em>evidence</em>.";
}

constexpr const char* words_key = R"(<h2 id="key">How to read it</h2>
<p><b>λ</b> is the subdominant eigenvalue of the matrix that carries the points around an extraordinary point from one level to the next: details there
shrink like its powers. <b>μ</b> is the largest one after it; curvature behaves like the powers of <b>μ/λ<sup>2</sup></b>: below one it tends to zero (a flat point), at
one it stays bounded (or grows like a logarithm, if the eigenvalue is defective), above one it diverges. Blocks are those of the discrete Fourier transform
around the point; block ±1 must lead for the surface to be single-sheeted. The <b>characteristic map</b> is the limit of the two subdominant eigenvectors; if it is
regular and injective, the limit is C<sup>1</sup>.</p>
<p>Folded parts open with a click; paper shows what is open.</p>
)";

}  // namespace
}  // namespace page

std::string report_page(const nlohmann::ordered_json& report) {
  using namespace page;
  check(report);
  const Json& schemes = at(report, "schemes");
  std::vector<Entry> contents;
  std::string body;
  const auto add = [&](const std::string& html, const char* id, const char* words) {
    if (html.empty()) return;
    body += html;
    contents.push_back({id, words});
  };
  const std::string kind = string(at(report, "kind"));
  if (at(report, "mesh").is_object()) {
    add(mesh_section(at(report, "mesh")), "surface", "The limit surface");
    for (const auto& [id, words] : {std::pair{"warnings", "Warnings"},
                                    {"worst", "Worst places"},
                                    {"inventory", "Inventory"},
                                    {"seams", "Seams"},
                                    {"curvature", "Curvature"}})
      if (body.find(std::string("<section id=\"") + id + "\"") != std::string::npos) contents.push_back({id, words});
  }
  if (at(report, "free_form").is_object()) {
    add(free_form_section(at(report, "free_form")), "shapes", "The verdict");
    for (const auto& [id, words] : {std::pair{"warnings", "Warnings"},
                                    {"seams", "Seams"},
                                    {"vertices", "Vertices"},
                                    {"curves", "Curves"},
                                    {"patches", "Patches"}})
      if (body.find(std::string("<section id=\"") + id + "\"") != std::string::npos) contents.push_back({id, words});
  }
  if (at(report, "curve").is_object()) add(curve_section(at(report, "curve")), "curve", "The knots");
  if (at(report, "sweep").is_object()) add(sweep_section(at(report, "sweep")), "sweep", "Over the option");
  add(summary_section(report), "summary", "Schemes side by side");
  if (kind == "schemes") add(words_key, "key", "How to read it");
  std::set<std::string> used;
  std::vector<std::string> ids;
  for (const Json& scheme : schemes) {
    const std::string name = string(at(scheme, "name"), "unnamed");
    std::string id = "scheme-" + identifier(name);
    while (!used.insert(id).second) id += "-again";
    contents.push_back({id, escaped(name)});
    ids.push_back(id);
  }
  std::vector<std::string> sections(ids.size());
  parallel_for_blocks(
      static_cast<std::int64_t>(ids.size()),
      [&](std::int64_t i, std::int64_t, std::int64_t) {
        sections[i] = scheme_section(at(schemes, i), ids[i], ids.size() > 1);
      },
      1);
  for (const std::string& section : sections) body += section;
  const std::string title = escaped(title_of(report));
  std::string html =
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<meta name=\"viewport\" "
      "content=\"width=device-width, initial-scale=1\">\n<title>" +
      title + "</title>\n<style>" + style + "</style>\n</head>\n<body id=\"top\">\n<header>\n<h1>" + title +
      "</h1>\n<p class=\"lead\">" + lead_of(report) + "</p>\n" + verdict_counts(report) +
      "</header>\n<nav class=\"contents\" aria-label=\"Contents\"><ul>";
  for (const Entry& e : contents) html += "<li><a href=\"#" + e.id + "\">" + e.words + "</a></li>";
  html += "</ul></nav>\n<main>\n" + body + "</main>\n<footer>Made by sublimit " +
          escaped(string(at(report, "program"))) +
          " from report.json, format version 1, and from nothing else.</footer>\n</body>\n</html>\n";
  return html;
}

}  // namespace sublimit
