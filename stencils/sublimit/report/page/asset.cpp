// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <map>

#include "sublimit/report/page/drawing.h"
#include "sublimit/report/page/plot.h"
#include "sublimit/report/page/sections.h"
#include "sublimit/report/page/surfaces.h"
#include "sublimit/report/page/text.h"

namespace sublimit::page {
namespace {

std::string inventory(const Json& list) {
  if (!list.is_array() || list.empty()) return {};
  Table table{"What is not an inner regular vertex or face",
              {"kind", "n", "count", "tangent plane", "curvature", "μ/λ<sup>2</sup>", "for example"},
              {},
              "wide text"};
  for (const Json& row : list) {
    std::string examples;
    const Json& some = at(row, "examples");
    for (std::size_t i = 0; i < some.size() && i < 6; ++i) examples += (i > 0 ? ", " : "") + shown(at(some, i));
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

/// Which edge, face or vertex a deviation belongs to.
std::string element(const Json& deviation) {
  const Json& edge = at(deviation, "edge");
  if (edge.is_array()) return "edge " + shown(at(edge, 0)) + "–" + shown(at(edge, 1));
  if (!at(deviation, "face").is_null()) return "within face " + shown(at(deviation, "face"));
  return "vertex " + shown(at(deviation, "vertex"));
}

/// "g1" as G with its superscript.
std::string order_words(const Json& what) {
  const std::string word = string(what);
  if (word.size() == 2 && word[0] == 'g') return "G<sup>" + escaped(word.substr(1)) + "</sup>";
  return prose(what);
}

/// How many listed deviations of one kind lie in each decade.
std::string histogram(const Json& list, const std::string& what) {
  std::map<int, int> decades;
  int most = 0;
  for (const Json& d : list) {
    const std::optional<double> v = number(at(d, "value"));
    if (string(at(d, "what")) == what && v && *v > 0)
      most = std::max(most, ++decades[static_cast<int>(std::floor(std::log10(*v)))]);
  }
  if (decades.empty()) return {};
  const int first = decades.begin()->first, count = decades.rbegin()->first - first + 1;
  const double width = 330. / count;
  std::string body = line(25, 130, 355, 130, "frame");
  for (int i = 0; i < count; ++i) {
    const int inside = decades.count(first + i) > 0 ? decades[first + i] : 0;
    const double height = 92. * inside / most, x = 25 + width * i, bar = std::min(56., .8 * width);
    if (inside > 0)
      body += "<rect x=\"" + svg::pixels(x + (width - bar) / 2) + "\" y=\"" + svg::pixels(130 - height) +
              "\" width=\"" + svg::pixels(bar) + "\" height=\"" + svg::pixels(height) + "\" class=\"f0\"/>" +
              text(x + width / 2, 125 - height, std::to_string(inside), {"middle", nullptr});
    if (count <= 9 || i % ((count + 8) / 9) == 0)
      body += text(x + width / 2, 147, "1e" + digits(first + i), {"middle", "quiet"});
  }
  const std::string unit = what == "g1" ? ", in degrees" : "";
  return figure(drawing(380, 156, "Deviations " + what + " by size", "", body),
                "<b>" + order_words(Json(what)) + " deviations listed below</b> by size" + unit +
                    "; a bar is the decade from its number up.");
}

std::string deviations(const Json& list, const std::string& caption) {
  if (!list.is_array() || list.empty()) return {};
  Table table{caption, {"where", "what", "value", "at"}, {}, "numbers"};
  for (std::size_t i = 0; i < list.size() && i < 20; ++i)
    table.rows.push_back({element(at(list, i)), order_words(at(at(list, i), "what")),
                          shown(at(at(list, i), "value"), 4), place(at(at(list, i), "at"))});
  return html(table);
}

std::string seams(const Json& s) {
  if (!s.is_object()) return {};
  Table table{"Largest deviations; G^2 as a part of the larger curvature",
              {"", "G<sup>0</sup>", "G<sup>1</sup>, degrees", "G<sup>2</sup>"},
              {},
              "numbers"};
  for (const auto& [key, words] : {std::pair{"tolerance", "tolerance"},
                                   {"inside", "inside the surface"},
                                   {"around_points", "around its points"},
                                   {"across_creases", "across creases"}}) {
    const Json& r = at(s, key);
    if (r.is_object())
      table.rows.push_back({words, shown(at(r, "g0"), 3), shown(at(r, "g1_degrees"), 3), shown(at(r, "g2"), 3)});
  }
  const Json& within = at(s, "within_tolerance");
  std::string text = "<section id=\"seams\"><h2>Seams between patches</h2>\n";
  text += facts({{"Seams", shown(at(s, "edges"))},
                 {"On creases", shown(at(s, "crease_edges"))},
                 {"On borders", shown(at(s, "border_edges"))},
                 {"Against the tolerance", within.is_boolean() ? is_true(within)
                                                                     ? "<span class=\"badge proved\">✓ within</span>"
                                                                     : "<span class=\"badge disproved\">✗ beyond</span>"
                                                               : dash}});
  text += html(table);
  const Json& listed = at(s, "beyond").empty() ? at(s, "worst") : at(s, "beyond");
  text += figures(histogram(listed, "g0") + histogram(listed, "g1") + histogram(listed, "g2"));
  text += deviations(at(s, "beyond"), "Beyond tolerance, the worst first");
  if (at(s, "beyond").empty()) text += deviations(at(s, "worst"), "The worst");
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
  return "<section id=\"curvature\"><h2>Curvature</h2>\n" +
         facts({{"Unbounded at", shown(at(c, "unbounded_at")) + " points"},
                {"Area", shown(at(c, "area"), 6)},
                {"Total Gauss curvature", shown(at(c, "total_gauss"), 6)},
                {"Samples", shown(at(c, "samples"))},
                {"Samples without curvature", shown(at(c, "without"))}}) +
         html(table) + "</section>\n";
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

}  // namespace

std::string place(const Json& at_) {
  if (!at_.is_array()) return dash;
  std::string text = "(";
  for (std::size_t i = 0; i < at_.size(); ++i) text += (i > 0 ? ", " : "") + shown(at(at_, i), 4);
  return text + ")";
}

std::string warnings_section(const Json& list) {
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

std::string mesh_section(const Json& mesh) {
  const Json& counts = at(mesh, "counts");
  const Json& box = at(mesh, "box");
  std::string text = "<section id=\"surface\"><h2>" + escaped(string(at(mesh, "file"), "mesh")) + "</h2>\n";
  text += facts({{"Scheme", literal(at(mesh, "scheme"))},
                 {"Vertices", shown(at(counts, "vertices"))},
                 {"Faces", shown(at(counts, "faces"))},
                 {"Edges", shown(at(counts, "edges"))},
                 {"Box", box.is_array() ? place(at(box, 0)) + " to " + place(at(box, 1)) : dash}});
  text += figures(asset_figure(mesh)) + figures(asset_stripes(mesh)) + "</section>\n";
  return text + warnings_section(at(mesh, "warnings")) + worst_places(at(mesh, "worst")) +
         inventory(at(mesh, "inventory")) + seams(at(mesh, "seams")) + curvature(at(mesh, "curvature"));
}

}  // namespace sublimit::page
