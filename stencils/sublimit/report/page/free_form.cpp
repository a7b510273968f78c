// SPDX-License-Identifier: Apache-2.0
// The report on free-form curves and surfaces: the verdict, the picture, then seams, vertices and curves as tables.
#include <algorithm>

#include "sublimit/report/page/drawing.h"
#include "sublimit/report/page/free_form_figure.h"
#include "sublimit/report/page/sections.h"
#include "sublimit/report/page/text.h"

namespace sublimit::page {
namespace {

constexpr std::size_t most_rows = 60;  // of a table; a count says how many more there are

/// "u = 1" of a line.
std::string line_words(const Json& line) {
  const char* across = at(line, "u").is_null() ? "v" : "u";
  return std::string(across) + " = " + shown(at(line, across), 4);
}

/// Where a seam is: its patches and their lines.
std::string lines_words(const Json& seam) {
  const Json& lines = at(seam, "lines");
  std::string text;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const Json& line = at(lines, i);
    const bool same = i > 0 && at(line, "patch") == at(at(lines, i - 1), "patch");
    if (same && line_words(line) == line_words(at(lines, i - 1))) continue;  // a knot's two sides
    text += (text.empty() ? "" : same ? ", " : "; ") + (same ? "" : shown(at(line, "patch")) + ": ") + line_words(line);
  }
  return text;
}

std::string c_sign(const Json& orders) {
  return "C<sup>" + (is_true(at(orders, "same")) ? "∞" : std::to_string(whole(at(orders, "c"), -1))) + "</sup>";
}
/// An order that nothing stands in the way of is the highest one that was looked for, or all of one map.
std::string g_sign(const Json& orders) {
  const std::string g = std::to_string(whole(at(orders, "g"), -1));
  if (string(at(orders, "obstacle")) != "none") return "G<sup>" + g + "</sup>";
  return is_true(at(orders, "same")) ? "G<sup>∞</sup>" : "G<sup>" + g + "</sup> at least";
}

/// "C^1, G^2" of orders; a word where there is no join.
std::string orders_words(const Json& orders) {
  if (!orders.is_object()) return dash;
  if (whole(at(orders, "g"), -1) < 0) return string(at(orders, "obstacle"), "gap");
  return c_sign(orders) + ", " + g_sign(orders);
}

/// The order G^k in a box, then C^k, or what stands in the way of G^1.
std::string measured_words(const Json& orders) {
  if (!orders.is_object()) return dash;
  const int g = whole(at(orders, "g"), -1);
  const char* css = g >= 2 ? "proved" : g == 1 ? "borderline" : "disproved";
  const std::string obstacle = string(at(orders, "obstacle"), "gap");
  const std::string word = g < 0 ? escaped(obstacle) : g_sign(orders);
  std::string text = std::string("<span class=\"badge ") + css + "\">" + word + "</span>";
  if (g >= 0) text += " " + c_sign(orders);
  return g == 0 && obstacle != "angle" ? text + ", " + escaped(obstacle) : text;
}

std::string rest_of(const Json& list, std::size_t total) {
  return list.size() >= total ? std::string()
                              : "<p class=\"quiet\">and " + std::to_string(total - list.size()) + " more</p>\n";
}

/// The first rows of a list, those with a condition.
template <class Condition>
Json first_rows(const Json& list, std::size_t& total, const Condition& condition) {
  Json rows = Json::array();
  total = 0;
  for (const Json& row : list)
    if (condition(row) && ++total <= most_rows) rows.push_back(row);
  return rows;
}

std::string seams_section(const Json& seams) {
  const Json& list = at(seams, "list");
  if (!list.is_array() || list.empty()) return {};
  std::string text = "<section id=\"seams\"><h2>Seams</h2>\n";
  std::vector<std::pair<std::string, std::string>> items;
  for (const auto& [kind, words] : {std::pair{"knot", "Lines of knots"},
                                    {"period", "Periods"},
                                    {"sides", "Whole sides"},
                                    {"reparametrised", "In other parameters"},
                                    {"partial", "T-junctions"},
                                    {"gap", "Gaps"},
                                    {"non-manifold", "Non-manifold"},
                                    {"collapsed", "Sides that are one point"},
                                    {"boundary", "Sides without a partner"}})
    if (whole(at(at(seams, "kinds"), kind)) > 0) items.emplace_back(words, shown(at(at(seams, "kinds"), kind)));
  items.emplace_back("Smooth lines of knots", shown(at(seams, "smooth_lines")));
  items.emplace_back("Boundary loops", shown(at(seams, "boundary_loops")));
  text += facts(items);
  std::size_t total = 0;
  const Json compared = first_rows(list, total, [](const Json& seam) { return at(seam, "measured").is_object(); });
  if (!compared.empty()) {
    Table table{
        "Seams, the worst first: largest gap, angle of normals, jump of curvature and its part of the curvature",
        {"seam", "kind", "patch: line", "measured", "exact", "gap", "degrees", "jump", "part", "at"},
        {},
        "wide numbers"};
    std::size_t i = 0;
    for (const Json& seam : compared) {
      const auto value = [&](const char* key) { return shown(at(at(seam, key), "value"), 3); };
      table.rows.push_back({std::to_string(i++), literal(at(seam, "kind")), lines_words(seam),
                            measured_words(at(seam, "measured")), orders_words(at(seam, "exact")), value("g0"),
                            value("g1_degrees"), value("curvature_jump"), shown(at(seam, "g2"), 3),
                            place(at(seam, "at"))});
    }
    text += html(table) + rest_of(compared, total);
    text +=
        "<p>C<sup>k</sup> is by the given parameters, G<sup>k</sup> after a change of them. <em>Measured</em> is up to "
        "rounding; <em>exact</em> is about exactly the numbers of the file, so sides that differ in the last bit have a "
        "gap there, and what is smooth but for rounded numbers has a kink.</p>\n";
  }
  const Json others = first_rows(list, total, [](const Json& seam) { return !at(seam, "measured").is_object(); });
  if (!others.empty()) {
    Table table{"Sides that are not compared", {"kind", "patch: line", "normal", "at"}, {}, "text"};
    for (const Json& seam : others) {
      const std::string plane = string(at(seam, "tangent_plane"));
      table.rows.push_back({literal(at(seam, "kind")), lines_words(seam),
                            plane.empty()    ? dash
                            : plane == "yes" ? "a limit"
                                             : "none",
                            place(at(seam, "at"))});
    }
    text += html(table) + rest_of(others, total);
  }
  return text + "</section>\n";
}

std::string vertices_section(const Json& list) {
  if (!list.is_array() || list.empty()) return {};
  // Those without a tangent plane first.
  std::vector<const Json*> sorted;
  for (const Json& vertex : list) sorted.push_back(&vertex);
  std::stable_sort(sorted.begin(), sorted.end(), [](const Json* a, const Json* b) {
    return number(at(*a, "plane_angle_degrees")).value_or(-1) > number(at(*b, "plane_angle_degrees")).value_or(-1);
  });
  Table table{"Corners of patches that meet; twist: what is left of the condition on twists, 1/length",
              {"patches", "corners", "tangent plane", "degrees", "twist", "enclosure", "at"},
              {},
              "wide numbers"};
  for (std::size_t i = 0; i < sorted.size() && i < most_rows; ++i) {
    const Json& vertex = *sorted[i];
    std::string patches;
    const Json& corners = at(vertex, "corners");
    for (std::size_t c = 0; c < corners.size() && c < 8; ++c)
      patches += (c > 0 ? ", " : "") + shown(at(at(corners, c), "patch"));
    const std::string plane = string(at(vertex, "tangent_plane"));
    const std::string sign = is_true(at(vertex, "degenerate")) ? "<span class=\"badge unknown\">degenerate</span>"
                             : plane == "yes"                  ? "<span class=\"badge proved\">✓ yes</span>"
                                                               : "<span class=\"badge disproved\">✗ no</span>";
    const Json& enclosed = at(vertex, "can_be_enclosed");
    const std::string enclosure =
        at(vertex, "enclosure").is_null()
            ? std::string(dash)
            : (is_true(enclosed) ? "fulfilled, " : "not fulfilled, ") + shown(at(vertex, "enclosure"), 3);
    table.rows.push_back({patches, std::to_string(corners.size()) + (is_true(at(vertex, "interior")) ? "" : ", open"),
                          sign, shown(at(vertex, "plane_angle_degrees"), 3), shown(at(vertex, "twist_residual"), 3),
                          enclosure, place(at(vertex, "at"))});
  }
  std::string text = "<section id=\"vertices\"><h2>Vertices</h2>\n" + html(table);
  if (sorted.size() > most_rows)
    text += "<p class=\"quiet\">and " + std::to_string(sorted.size() - most_rows) + " more</p>\n";
  return text +
         "<p>Where an even number of curves meets, there is a G<sup>1</sup> surface through them only if the condition "
         "of enclosure is fulfilled (Peters 1991).</p></section>\n";
}

std::string joints_section(const Json& joints, const Json& curves) {
  if (!curves.is_array() || curves.empty()) return {};
  std::string text = "<section id=\"curves\"><h2>Curves</h2>\n";
  text += facts({{"Curves", std::to_string(curves.size())},
                 {"Free ends", shown(at(joints, "free_ends"))},
                 {"Points where three or more end", shown(at(joints, "branches"))}});
  std::size_t total = 0;
  const Json rows = first_rows(at(joints, "list"), total, [](const Json&) { return true; });
  if (!rows.empty()) {
    Table table{
        "Joints, the worst first: gap, angle of tangents, jump of the curvature vector and its part of the curvature",
        {"joint", "where", "measured", "exact", "gap", "degrees", "jump", "part", "ratios", "at"},
        {},
        "wide numbers"};
    std::size_t i = 0;
    for (const Json& joint : rows) {
      const Json &of = at(joint, "curves"), &t = at(joint, "parameters");
      const bool is_knot = string(at(joint, "kind")) == "knot";
      const std::string where = is_knot ? "curve " + shown(at(of, 0)) + " at t = " + shown(at(t, 0), 4)
                                : at(of, 0) == at(of, 1)
                                    ? "curve " + shown(at(of, 0)) + ", its ends"
                                    : "curve " + shown(at(of, 0)) + ", t = " + shown(at(t, 0), 4) + "; curve " +
                                          shown(at(of, 1)) + ", t = " + shown(at(t, 1), 4);
      std::string ratios;
      for (const Json& r : at(joint, "ratios")) ratios += (ratios.empty() ? "" : ", ") + shown(r, 4);
      table.rows.push_back({std::to_string(i++), where, measured_words(at(joint, "measured")),
                            orders_words(at(joint, "exact")), shown(at(joint, "g0"), 3),
                            shown(at(joint, "g1_degrees"), 3), shown(at(joint, "curvature_jump"), 3),
                            shown(at(joint, "g2"), 3), ratios.empty() ? dash : ratios, place(at(joint, "at"))});
    }
    text += html(table) + rest_of(rows, total);
  }
  return text + "</section>\n";
}

std::string patches_section(const Json& list) {
  if (!list.is_array() || list.empty()) return {};
  const bool recipes = !at(at(list, 0), "recipe").is_null();
  Table table{
      "", {"patch", recipes ? "of" : "line", "basis", "degrees", "control points", "faces", "u", "v"}, {}, "numbers"};
  for (std::size_t i = 0; i < list.size() && i < most_rows; ++i) {
    const Json &patch = at(list, i), &u = at(patch, "u"), &v = at(patch, "v");
    const auto range = [](const Json& d) {
      return shown(at(at(d, "range"), 0), 4) + " to " + shown(at(at(d, "range"), 1), 4);
    };
    table.rows.push_back({std::to_string(i), recipes ? literal(at(patch, "recipe")) : shown(at(patch, "line")),
                          (is_true(at(patch, "rational")) ? "rational " : "") + literal(at(patch, "basis")),
                          shown(at(u, "degree")) + " × " + shown(at(v, "degree")),
                          shown(at(u, "control_points")) + " × " + shown(at(v, "control_points")),
                          shown(at(patch, "faces")), range(u), range(v)});
  }
  std::string text = "<section id=\"patches\"><h2>Patches</h2>\n" + html(table);
  if (list.size() > most_rows)
    text += "<p class=\"quiet\">and " + std::to_string(list.size() - most_rows) + " more</p>\n";
  return text + "</section>\n";
}

std::string beyond_table(const Json& list) {
  if (!list.is_array() || list.empty()) return {};
  Table table{"Beyond the tolerance, the worst first", {"where", "what", "value", "at"}, {}, "numbers"};
  for (const Json& e : list) {
    const bool is_joint = !at(e, "joint").is_null();
    const std::string what = string(at(e, "what"));
    table.rows.push_back({(is_joint ? "joint " : "seam ") + shown(at(e, is_joint ? "joint" : "seam")),
                          what.size() == 2 ? "G<sup>" + escaped(what.substr(1)) + "</sup>" : escaped(what),
                          shown(at(e, "value"), 4), place(at(e, "at"))});
  }
  return html(table);
}

}  // namespace

std::string free_form_section(const Json& report) {
  const Json &counts = at(report, "counts"), &box = at(report, "box"), &verdict = at(report, "verdict");
  const Json& tolerance = at(report, "tolerance");
  std::string text = "<section id=\"shapes\"><h2>" + escaped(string(at(report, "file"), "shapes")) + "</h2>\n";
  for (const char* key : {"seams", "joints"})
    if (const Json& v = at(verdict, key); v.is_object())
      text += std::string("<p class=\"lead\"><b>") + (key[0] == 's' ? "Surfaces" : "Curves") + ":</b> " +
              prose(at(v, "says")) + ".</p>\n";
  const bool asked =
      !at(tolerance, "g0").is_null() || !at(tolerance, "g1_degrees").is_null() || !at(tolerance, "g2").is_null();
  text +=
      facts({{"Surfaces", shown(at(counts, "surfaces"))},
             {"Curves", shown(at(counts, "curves"))},
             {"Box", box.is_array() ? place(at(box, 0)) + " to " + place(at(box, 1)) : dash},
             {"Against the tolerance",
              !asked                                         ? ""
              : !at(report, "within_tolerance").is_boolean() ? "<span class=\"badge unknown\">nothing to compare</span>"
              : is_true(at(report, "within_tolerance"))      ? "<span class=\"badge proved\">✓ within</span>"
                                                             : "<span class=\"badge disproved\">✗ beyond</span>"}});
  const Json &seams = at(report, "seams"), &joints = at(report, "joints");
  if (asked || !at(at(seams, "deviation"), "g0").is_null() || !at(at(joints, "deviation"), "g0").is_null()) {
    Table table{"Largest deviations; G^2 as a part of the larger curvature",
                {"", "G<sup>0</sup>", "G<sup>1</sup>, degrees", "G<sup>2</sup>"},
                {},
                "numbers"};
    for (const auto& [words, r] : {std::pair{"tolerance", &tolerance},
                                   {"seams", &at(seams, "deviation")},
                                   {"joints of curves", &at(joints, "deviation")}})
      if (r->is_object() && (r == &tolerance ? asked : !at(*r, "g0").is_null()))
        table.rows.push_back({words, shown(at(*r, "g0"), 3), shown(at(*r, "g1_degrees"), 3), shown(at(*r, "g2"), 3)});
    text += html(table);
  }
  text += beyond_table(at(report, "beyond"));
  text += figures(free_form_figure(report)) + "</section>\n";
  return text + warnings_section(at(report, "warnings")) + seams_section(seams) +
         vertices_section(at(report, "vertices")) + joints_section(joints, at(report, "curves")) +
         patches_section(at(report, "patches"));
}

}  // namespace sublimit::page
