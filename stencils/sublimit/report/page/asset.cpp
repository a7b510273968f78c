// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "sublimit/report/page/drawing.h"
#include "sublimit/report/page/plot.h"
#include "sublimit/report/page/sections.h"
#include "sublimit/report/page/surfaces.h"
#include "sublimit/report/page/text.h"

namespace sublimit::page {
namespace {

std::string place(const Json& at_) {
  if (!at_.is_array()) return dash;
  std::string text = "(";
  for (std::size_t i = 0; i < at_.size(); ++i) text += (i > 0 ? ", " : "") + shown(at_[i], 4);
  return text + ")";
}

std::string inventory(const Json& list) {
  if (!list.is_array() || list.empty()) return {};
  Table table{"What is not an inner regular vertex or face",
              {"kind", "n", "count", "tangent plane", "curvature", "μ/λ<sup>2</sup>", "for example"},
              {},
              "wide text"};
  for (const Json& row : list) {
    std::string examples;
    const Json& some = at(row, "examples");
    for (std::size_t i = 0; i < some.size() && i < 6; ++i) examples += (i > 0 ? ", " : "") + shown(some[i]);
    const std::string plane = string(at(row, "tangent_plane"));
    const std::string sign = plane == "yes"    ? "<span class=\"badge proved\">✓ yes</span>"
                             : plane == "slow" ? "<span class=\"badge borderline\">± slow</span>"
                             : plane == "no"   ? "<span class=\"badge disproved\">✗ no</span>"
                                               : literal(at(row, "tangent_plane"));
    table.rows.push_back({literal(at(row, "kind")), shown(at(row, "n")), shown(at(row, "count")), sign,
                          literal(at(row, "curvature")), shown(at(row, "ratio"), 4),
                          examples.empty() ? dash : examples});
  }
  return "<section id=\"inventory\"><h2>Inventory</h2>\n" + html(table) + "</section>\n";
}

/// Values from 10^-16 up in decades, as bars.
std::string histogram(const Json& beyond) {
  struct Bin {
    int count = 0;
  };
  std::vector<std::pair<int, int>> decades;
  for (const Json& b : beyond) {
    const std::optional<double> v = number(at(b, "value"));
    if (!v || *v <= 0) continue;
    const int decade = static_cast<int>(std::floor(std::log10(*v)));
    auto found = std::find_if(decades.begin(), decades.end(), [&](const auto& d) { return d.first == decade; });
    if (found == decades.end())
      decades.emplace_back(decade, 1);
    else
      ++found->second;
  }
  if (decades.empty()) return {};
  std::sort(decades.begin(), decades.end());
  int most = 0;
  for (const auto& [decade, count] : decades) most = std::max(most, count);
  const double width = 320. / static_cast<double>(decades.size());
  std::string body = line(30, 130, 350, 130, "frame");
  for (std::size_t i = 0; i < decades.size(); ++i) {
    const double height = 96. * decades[i].second / most, x = 30 + width * static_cast<double>(i),
                 bar = std::min(60., .7 * width);
    body += "<rect x=\"" + svg::pixels(x + (width - bar) / 2) + "\" y=\"" + svg::pixels(130 - height) + "\" width=\"" +
            svg::pixels(bar) + "\" height=\"" + svg::pixels(height) + "\" class=\"f0\"/>" +
            text(x + width / 2, 126 - height, std::to_string(decades[i].second), {"middle", nullptr}) +
            text(x + width / 2, 146, "1e" + digits(decades[i].first), {"middle", "quiet"});
  }
  return figure(drawing(380, 156, "Seams beyond tolerance by size", "", body),
                "<b>Seams beyond tolerance</b> by size; each bar is a decade from its number up.");
}

std::string seams(const Json& s) {
  if (!s.is_object()) return {};
  Table table{"Largest deviations", {"", "G<sup>0</sup>", "G<sup>1</sup>, degrees", "G<sup>2</sup>"}, {}, "numbers"};
  const auto row = [&](const char* key, const char* words) {
    const Json& r = at(s, key);
    if (r.is_object())
      table.rows.push_back({words, shown(at(r, "g0"), 3), shown(at(r, "g1_degrees"), 3), shown(at(r, "g2"), 3)});
  };
  row("tolerance", "tolerance");
  row("inside", "inside the surface");
  row("across_creases", "across creases");
  const Json& within = at(s, "within_tolerance");
  std::string text =
      "<section id=\"seams\"><h2>Seams between patches</h2>\n<p>" + shown(at(s, "edges")) + " seams. " +
      (within.is_boolean() ? is_true(within) ? "<span class=\"badge proved\">✓ within tolerance</span>"
                                             : "<span class=\"badge disproved\">✗ beyond tolerance</span>"
                           : "") +
      "</p>\n" + html(table);
  const Json& beyond = at(s, "beyond");
  if (beyond.is_array() && !beyond.empty()) {
    text += figures(histogram(beyond));
    Table worst{"The first seams beyond tolerance", {"edge", "what", "value", "at"}, {}, "numbers"};
    for (std::size_t i = 0; i < beyond.size() && i < 20; ++i) {
      const Json& edge = at(beyond[i], "edge");
      worst.rows.push_back({shown(at(edge, 0)) + "–" + shown(at(edge, 1)), literal(at(beyond[i], "what")),
                            shown(at(beyond[i], "value"), 4), place(at(beyond[i], "at"))});
    }
    text += html(worst);
  }
  return text + "</section>\n";
}

std::string curvature(const Json& c) {
  if (!c.is_object()) return {};
  Table table{"Over the limit surface", {"", "least", "greatest", "mean", "quantiles"}, {}, "numbers"};
  for (const char* key : {"gauss", "mean"}) {
    const Json& row = at(c, key);
    std::string quantiles;
    for (const Json& q : at(row, "quantiles")) quantiles += (quantiles.empty() ? "" : ", ") + shown(q, 3);
    table.rows.push_back({key[0] == 'g' ? "Gauss curvature" : "mean curvature", shown(at(row, "min"), 4),
                          shown(at(row, "max"), 4), shown(at(row, "mean"), 4), quantiles.empty() ? dash : quantiles});
  }
  return "<section id=\"curvature\"><h2>Curvature</h2>\n" + html(table) + "<p>Unbounded at " +
         shown(at(c, "unbounded_at")) + " points.</p></section>\n";
}

std::string worst_places(const Json& list) {
  if (!list.is_array() || list.empty()) return {};
  Table table{"Numbered as in the picture", {"", "what", "value", "face", "u, v", "at"}, {}, "text"};
  int i = 0;
  for (const Json& w : list) {
    const Json& uv = at(w, "uv");
    table.rows.push_back({std::to_string(++i), prose(at(w, "what")), shown(at(w, "value"), 4), shown(at(w, "face")),
                          shown(at(uv, 0), 4) + ", " + shown(at(uv, 1), 4), place(at(w, "at"))});
  }
  return "<section id=\"worst\"><h2>Worst places</h2>\n" + html(table) + "</section>\n";
}

std::string warnings(const Json& list) {
  if (!list.is_array() || list.empty()) return {};
  Table table{"", {"severity", "what", "where", "advice"}, {}, "wide text"};
  for (const Json& w : list) {
    const std::string severity = string(at(w, "severity"));
    const std::string css = severity == "error" ? "disproved" : severity == "warning" ? "borderline" : "unknown";
    const std::string sign = severity == "error" ? "✗ " : severity == "warning" ? "! " : "· ";
    table.rows.push_back({"<span class=\"badge " + css + "\">" + sign + escaped(severity) + "</span>",
                          prose(at(w, "says")), literal(at(w, "where")), prose(at(w, "advice"))});
  }
  return "<section id=\"warnings\"><h2>Warnings</h2>\n" + html(table) + "</section>\n";
}

}  // namespace

std::string mesh_section(const Json& mesh) {
  const Json& counts = at(mesh, "counts");
  const Json& box = at(mesh, "box");
  std::string text = "<section id=\"surface\"><h2>" + escaped(string(at(mesh, "file"), "mesh")) + "</h2>\n";
  text += facts({{"Scheme", literal(at(mesh, "scheme"))},
                 {"Vertices", shown(at(counts, "vertices"))},
                 {"Faces", shown(at(counts, "faces"))},
                 {"Edges", shown(at(counts, "edges"))},
                 {"Box", box.is_array() ? place(at(box, 0)) + " to " + place(at(box, 1)) : dash}});
  text += figures(asset_figure(mesh)) + "</section>\n";
  return text + warnings(at(mesh, "warnings")) + worst_places(at(mesh, "worst")) + inventory(at(mesh, "inventory")) +
         seams(at(mesh, "seams")) + curvature(at(mesh, "curvature"));
}

}  // namespace sublimit::page
