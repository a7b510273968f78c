// SPDX-License-Identifier: Apache-2.0
// What changes with the valence: the leading eigenvalues of every block, mu/lambda^2, the verdicts.
#include <algorithm>
#include <cmath>
#include <map>

#include "sublimit/report/page/drawing.h"
#include "sublimit/report/page/plot.h"
#include "sublimit/report/page/sections.h"
#include "sublimit/report/page/text.h"

namespace sublimit::page {
namespace {

constexpr double same = 1e-9;

int folded(const Json& block, int n) {
  const int k = whole(block, -1);
  return k < 0 ? -1 : std::min(k, n - k);
}

std::string spectrum_figure(const std::vector<const Json*>& all, const std::string& kind, const std::string& scheme) {
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
  lambda.name = "λ, and below it λ<sup>2</sup>";
  plot.series.push_back(lambda);
  plot.series.push_back(square);
  for (auto& [k, s] : leading) {
    s.name = k == 0 ? "block 0, after 1" : "block ±" + std::to_string(k);
    s.kind = k == 0 ? 3 : k == 1 ? 0 : k == 2 ? 1 : k == 3 ? 2 : 4;
    plot.series.push_back(s);
  }
  return figure(
      plot,
      "<b>Spectra.</b> Each mark is the largest eigenvalue of its block. For a tangent plane block ±1 must be "
      "alone on top; what lies above the lower dashed line, λ<sup>2</sup>, makes curvature diverge.");
}

std::string ratio_figure(const std::vector<const Json*>& all, const std::string& kind, const std::string& scheme) {
  Plot plot{"Ratio mu/lambda^2 over valence, " + scheme, "", kind == "face" ? "corners of the face" : "valence",
            "mu/lambda^2"};
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
  return figure(plot,
                "<b>Curvature at the extraordinary point.</b> Below one it tends to zero, above one it grows without "
                "bound; at one it stays bounded, or grows like a logarithm where the eigenvalue is defective.");
}

}  // namespace

std::string over_valences(const Json& neighborhoods, const std::string& kind, const std::string& scheme,
                          const std::string& id) {
  std::vector<const Json*> all;
  for (const Json& n : neighborhoods)
    if (string(at(n, "kind")) == kind) all.push_back(&n);
  if (all.empty()) return {};
  std::stable_sort(all.begin(), all.end(),
                   [](const Json* a, const Json* b) { return whole(at(*a, "n")) < whole(at(*b, "n")); });
  std::string text;
  if (all.size() > 1) text = figures(spectrum_figure(all, kind, scheme) + ratio_figure(all, kind, scheme));
  Table table{kind == "face" ? "Faces by their number of corners" : "Vertices by valence",
              {kind == "face" ? "corners" : "valence", "λ", "μ", "μ/λ<sup>2</sup>", "μ in blocks", "C<sup>1</sup>",
               "curvature", "shapes", "curvature in L<sup>p</sup>"},
              {},
              "numbers wide"};
  for (const Json* n : all) {
    const Json& list = at(*n, "verdicts");
    const Json &curvature = verdict_on(list, "curvature"), &shapes = verdict_on(list, "shapes"),
               &integrable = verdict_on(list, "curvature-integrability");
    std::string blocks;
    for (const Json& k : at(*n, "mu_blocks")) blocks += (blocks.empty() ? "" : ", ") + shown(k);
    const int valence = whole(at(*n, "n"));
    std::string p = dash;
    if (integrable.is_object() && integrable.contains("p"))
      p = at(integrable, "p").is_null() ? "every p" : "p &lt; " + shown(at(integrable, "p"), 4);
    table.rows.push_back(
        {"<a href=\"#" + id + "-" + kind + "-" + std::to_string(valence) + "\">" + std::to_string(valence) + "</a>",
         shown(at(*n, "lambda"), 8), shown(at(*n, "mu"), 8), shown(at(*n, "ratio"), 5), blocks.empty() ? dash : blocks,
         badge(at(verdict_on(list, "c1"), "verdict")), literal(at(curvature, "curvature")),
         literal(at(shapes, "shapes")), p});
  }
  return text + html(table);
}

}  // namespace sublimit::page
