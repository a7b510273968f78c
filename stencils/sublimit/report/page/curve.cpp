// SPDX-License-Identifier: Apache-2.0
// Reports on a piecewise curve, and on a scheme as one of its options varies.
#include <algorithm>
#include <cmath>

#include "sublimit/report/page/drawing.h"
#include "sublimit/report/page/plane.h"
#include "sublimit/report/page/plot.h"
#include "sublimit/report/page/sections.h"
#include "sublimit/report/page/text.h"

namespace sublimit::page {
namespace {

/// Points [x, y(, z)] in a list, whatever it is called; empty if it is none.
std::vector<Point> points_of(const Json& list) {
  std::vector<Point> points;
  for (const Json& p : list) {
    const std::optional<double> x = number(at(p, 0)), y = number(at(p, 1));
    if (!x || !y) return {};
    points.emplace_back(*x, *y);
  }
  return points;
}

/// A point of a Bezier piece by de Casteljau.
Point bezier(std::vector<Point> b, double t) {
  for (std::size_t n = b.size(); n > 1; --n)
    for (std::size_t i = 0; i + 1 < n; ++i) b[i] = (1 - t) * b[i] + t * b[i + 1];
  return b.front();
}

/// Derivatives of the change of parameter that G^n needs: the first must be positive.
std::string ratios(const Json& knot) {
  std::string text;
  for (const Json& r : at(knot, "ratios")) text += (text.empty() ? "" : ", ") + shown(r, 5);
  return text.empty() ? shown(at(knot, "tangent_ratio"), 5) : text;
}

std::string curve_figure(const Json& curve) {
  std::vector<std::vector<Point>> nets;
  std::vector<Point> everything;
  for (const Json& piece : at(curve, "pieces")) {
    std::vector<Point> net = points_of(piece.is_object() ? at(piece, "bezier") : piece);
    if (net.size() < 2) continue;
    everything.insert(everything.end(), net.begin(), net.end());
    nets.push_back(std::move(net));
  }
  if (nets.empty()) return {};
  const Fit fit = fit_points(everything, 760, 460, 34);
  std::string body;
  for (const std::vector<Point>& net : nets) body += path(path_data(fit.all(net)), "net");
  for (std::size_t i = 0; i < nets.size(); ++i) {
    std::vector<Point> samples;
    for (int t = 0; t <= 40; ++t) samples.push_back(bezier(nets[i], t / 40.));
    body += path(path_data(fit.all(samples)), i % 2 == 0 ? "curve l0" : "curve l1");
  }
  for (std::size_t i = 0; i < nets.size(); ++i) body += mark(0, fit.x(nets[i].front()), fit.y(nets[i].front()), 4);
  body += mark(0, fit.x(nets.back().back()), fit.y(nets.back().back()), 4);
  return figure(drawing(fit.width, fit.height, "The curve, its pieces in turn in two colours", "", body),
                "<b>The curve</b>, its control polygons, and the knots between its pieces.", true);
}

}  // namespace

std::string curve_section(const Json& curve) {
  std::string text =
      "<section id=\"curve\"><h2>Continuity at the knots</h2>\n" + facts({{"Degree", shown(at(curve, "degree"))}});
  text += figures(curve_figure(curve));
  Table table{"C^n: equal derivatives; G^n: equal after a change of speed, which must be positive",
              {"knot", "C", "G", "ratios", "verdict", "because"},
              {},
              "wide text"};
  for (const Json& k : at(curve, "knots")) {
    const auto order = [&](const char* key, const char* letter) {
      const Json& n = at(k, key);
      if (n.is_number_integer() && n.get<int>() < 0) return std::string("not joined");
      return n.is_null() ? std::string(dash) : std::string(letter) + "<sup>" + shown(n) + "</sup>";
    };
    table.rows.push_back({shown(at(k, "at"), 6), order("c", "C"), order("g", "G"), ratios(k), badge(at(k, "verdict")),
                          prose(at(k, "because"))});
  }
  return text + html(table) + "</section>\n";
}

std::string sweep_section(const Json& sweep) {
  const std::string option = string(at(sweep, "option"), "option");
  Plot plot{"Smoothness over " + option, "", option, ""};
  plot.width = 760;
  plot.height = 400;
  const Json& values = at(sweep, "values");
  int kind = 0;
  for (const Json& series : at(sweep, "series")) {
    Series s{prose(at(series, "name")), {}, kind++, values.size() <= 24};
    for (std::size_t i = 0; i < values.size(); ++i)
      s.points.emplace_back(number(at(values, i)).value_or(0), number(at(at(series, "values"), i)));
    plot.series.push_back(std::move(s));
  }
  std::string text = "<section id=\"sweep\"><h2>Over the option " + escaped(option) + "</h2>\n";
  text += figures(figure(plot, "<b>Smoothness over the option.</b> Gaps are where nothing is known.", true));
  const Json& findings = at(sweep, "findings");
  if (findings.is_array() && !findings.empty()) {
    text += "<ul class=\"plain\">";
    for (const Json& f : findings) text += "<li>" + prose(f) + "</li>";
    text += "</ul>\n";
  }
  Table table{"", {escaped(option)}, {}, "numbers"};
  for (const Json& series : at(sweep, "series")) table.heads.push_back(prose(at(series, "name")));
  for (std::size_t i = 0; i < values.size(); ++i) {
    std::vector<std::string> row = {shown(at(values, i), 6)};
    for (const Json& series : at(sweep, "series")) row.push_back(shown(at(at(series, "values"), i), 6));
    table.rows.push_back(row);
  }
  return text + "<details><summary>The numbers</summary>" + html(table) + "</details></section>\n";
}

}  // namespace sublimit::page
