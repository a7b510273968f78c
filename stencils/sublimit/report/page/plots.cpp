// SPDX-License-Identifier: Apache-2.0
// Figures that are plots of numbers of the report.
#include <algorithm>
#include <cmath>
#include <map>

#include "sublimit/report/page/drawing.h"
#include "sublimit/report/page/figures.h"
#include "sublimit/report/page/plot.h"

namespace sublimit::page {
namespace {

constexpr double same = 1e-9;

int folded(const Json& block, int n) {
  const int k = whole(block, -1);
  return k < 0 ? -1 : std::min(k, n - k);
}

Json spectrum_figure(const std::vector<const Json*>& all, const std::string& kind, const std::string& scheme) {
  Plot plot{"Leading eigenvalues over valence, " + scheme,
            "Modulus of the leading eigenvalues by Fourier block, with lambda and its square",
            kind == "face" ? "corners of the face" : "valence", "modulus"};
  plot.whole_x = plot.zero_y = true;
  plot.height = 300;
  std::map<int, Series> leading;
  Series rest{"further eigenvalues", {}, 7, true, false, true};
  Series lambda{"λ", {}, 0, false, true, false, true}, square{"", {}, 0, false, true, false, true};
  for (const Json* n : all) {
    const int valence = whole(at(*n, "n"));
    const double x = valence;
    std::map<int, double> seen;
    std::vector<double> drawn;
    for (const Json& e : at(*n, "spectrum")) {
      const std::optional<double> modulus = number(at(e, "modulus"));
      if (!modulus) continue;
      const int k = folded(at(e, "block"), valence);
      if (k == 0 && std::abs(*modulus - 1) < same) continue;
      const bool first = k >= 0 && k <= 4 && seen.try_emplace(k, *modulus).second;
      if (first) {
        leading[k].points.emplace_back(x, *modulus);
      } else if (drawn.size() < 5 && *modulus > .02 &&
                 std::none_of(drawn.begin(), drawn.end(), [&](double d) { return std::abs(d - *modulus) < .004; })) {
        rest.points.emplace_back(x, *modulus);
        drawn.push_back(*modulus);
      }
    }
    const std::optional<double> l = number(at(*n, "lambda"));
    lambda.points.emplace_back(x, l);
    square.points.emplace_back(x, l ? std::optional(*l * *l) : l);
  }
  if (!rest.points.empty()) plot.series.push_back(rest);
  lambda.name = "λ, and below it λ²";
  plot.series.push_back(lambda);
  plot.series.push_back(square);
  for (auto& [k, s] : leading) {
    s.name = k == 0 ? "block 0, after 1" : "block ±" + std::to_string(k);
    s.kind = k == 0 ? 3 : k == 1 ? 0 : k == 2 ? 1 : k == 3 ? 2 : 4;
    plot.series.push_back(s);
  }
  return figure(plot);
}

Json ratio_figure(const std::vector<const Json*>& all, const std::string& kind, const std::string& scheme) {
  Plot plot{"Ratio mu/lambda^2 over valence, " + scheme, "", kind == "face" ? "corners of the face" : "valence",
            "μ/λ²"};
  plot.whole_x = true;
  plot.height = 300;
  plot.rules = {{1, ""}};
  Series line{"", {}, 7, false, true, true};
  const char* const words[5] = {"flat", "bounded", "logarithmic", "divergent", "not decided"};
  const int kinds[5] = {0, 2, 4, 1, 7};
  std::vector<Series> classes(5);
  for (int i = 0; i < 5; ++i) classes[i].name = words[i], classes[i].kind = kinds[i], classes[i].line = false;
  for (const Json* n : all) {
    const double x = whole(at(*n, "n"));
    const std::optional<double> ratio = number(at(*n, "ratio"));
    line.points.emplace_back(x, ratio);
    const std::string curvature = string(at(verdict_on(at(*n, "verdicts"), "curvature"), "curvature"));
    const auto which = std::find(std::begin(words), std::end(words) - 1, curvature) - std::begin(words);
    classes[which].points.emplace_back(x, ratio);
  }
  plot.series.push_back(line);
  for (const Series& s : classes)
    if (!s.points.empty()) plot.series.push_back(s);
  return figure(plot);
}

/// How many listed deviations of one kind lie in each decade.
Json histogram(const Json& list, const std::string& what) {
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
  return figure(drawing(380, 156, "Deviations " + what + " by size", "", body));
}

}  // namespace

Json valence_figures(const Json& neighborhoods, const std::string& kind, const std::string& scheme) {
  std::vector<const Json*> all;
  for (const Json& n : neighborhoods)
    if (string(at(n, "kind")) == kind) all.push_back(&n);
  if (all.size() < 2) return {};
  std::stable_sort(all.begin(), all.end(),
                   [](const Json* a, const Json* b) { return whole(at(*a, "n")) < whole(at(*b, "n")); });
  return {{"spectra", spectrum_figure(all, kind, scheme)}, {"ratio", ratio_figure(all, kind, scheme)}};
}

/// An interval of exponents over whole numbers: what is known from below and from above.
Json exponent_figure(const Json& smoothness, const std::string& scheme) {
  const Json& exponent = at(smoothness, "exponent");
  const std::optional<double> low = number(at(exponent, 0)), high = number(at(exponent, 1));
  if (!low && !high) return {};
  const double greatest = std::max({4., std::ceil(low.value_or(0) + .5), std::ceil(high.value_or(0) + .5)});
  const auto x = [&](double v) { return 24 + v / greatest * 332; };
  std::string body = line(x(0), 56, x(greatest), 56, "frame");
  for (int i = 0; i <= static_cast<int>(greatest); ++i)
    body += line(x(i), 52, x(i), 60, "frame") + text(x(i), 76, std::to_string(i), {"middle", "quiet"});
  const double from = std::max(0., low.value_or(0)), to = std::max(from, high.value_or(greatest));
  if (high && to - from < 1e-6) {
    body += mark(3, x(from), 56, 5.5);
    body += text(std::clamp(x(from), 40., 340.), 38, digits(from, 6), {"middle", nullptr});
  } else {
    body += "<rect x=\"" + svg::pixels(x(from)) + "\" y=\"51\" width=\"" + svg::pixels(std::max(2., x(to) - x(from))) +
            "\" height=\"10\" rx=\"3\" class=\"f0\"/>";
    const std::string words =
        (low ? digits(*low, 6) : std::string("?")) + " … " + (high ? digits(*high, 6) : std::string("?"));
    body += text(std::clamp((x(from) + x(to)) / 2, 90., 290.), 38, words, {"middle", nullptr});
  }
  return figure(drawing(380, 88, "Hoelder exponent of " + scheme, "", body));
}

Json normals_figure(const Json& neighborhood, const std::string& name) {
  const Json& normals = at(neighborhood, "normals");
  const Json &steps = at(normals, "steps"), &spread = at(normals, "spread_degrees");
  Plot plot{"Spread of normals by ring, " + name, "", "steps", "degrees"};
  plot.log_y = true;
  Series s{"", {}, 0};
  for (std::size_t i = 0; i < steps.size() && i < spread.size(); ++i)
    s.points.emplace_back(number(at(steps, i)).value_or(static_cast<double>(i)), number(at(spread, i)));
  plot.series = {s};
  return figure(plot);
}

Json sweep_figure(const Json& sweep) {
  const std::string option = string(at(sweep, "option"), "option");
  Plot plot{"Smoothness over " + option, "", option, ""};
  plot.width = 760;
  plot.height = 400;
  const Json& values = at(sweep, "values");
  int kind = 0;
  for (const Json& series : at(sweep, "series")) {
    Series s{string(at(series, "name")), {}, kind++, values.size() <= 24};
    for (std::size_t i = 0; i < values.size(); ++i)
      s.points.emplace_back(number(at(values, i)).value_or(0), number(at(at(series, "values"), i)));
    plot.series.push_back(std::move(s));
  }
  return figure(plot);
}

Json deviation_figures(const Json& seams) {
  const Json& listed = at(seams, at(seams, "beyond").empty() ? "worst" : "beyond");
  Json figures;
  for (const char* what : {"g0", "g1", "g2"}) figures[what] = histogram(listed, what);
  return figures;
}

}  // namespace sublimit::page
