// SPDX-License-Identifier: Apache-2.0
#include "commands/explain.h"

#include <fmt/core.h>

#include <cmath>
#include <vector>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/error.h"

namespace sublimit::cli {
namespace {

std::string number(double x) { return format_number(x); }

/// As many digits as tell numbers apart for a reader.
std::string rounded(double x) { return fmt::format("{:.6g}", std::abs(x) < 5e-16 ? 0 : x); }

std::string text_of(const std::vector<std::complex<double>>& spectrum) {
  constexpr size_t most = 12;
  std::string text;
  for (size_t i = 0; i < std::min(most, spectrum.size()); ++i) {
    const std::complex<double> z = spectrum[i];
    const bool is_real = std::abs(z.imag()) <= 1e-12 * std::abs(z);
    text += (i == 0 ? "" : ", ") + rounded(z.real());
    if (!is_real) text += (z.imag() < 0 ? " - " : " + ") + rounded(std::abs(z.imag())) + "i";
  }
  return text + (spectrum.size() > most ? fmt::format(", ... ({} in all)", spectrum.size()) : "");
}

}  // namespace

Place explained_place(const std::string& text) {
  std::vector<std::string> parts{""};
  for (const char c : text)
    if (c == ',')
      parts.emplace_back();
    else
      parts.back() += c;
  if (parts.size() == 3) {
    const auto face = parse_number<Index>(parts[0]);
    const auto u = parse_number<double>(parts[1]), v = parse_number<double>(parts[2]);
    if (face && u && v) return {face.value, u.value, v.value};
  }
  throw InvalidOption("--explain " + text +
                      ": it should be FACE,U,V: the number of a face and two parameters, like 0,0.25,0.5");
}

std::string explanation(const LimitMap& map, const Points& points, const Place& place) {
  const LimitPath path = map.explain(place);
  std::string text =
      fmt::format("{:>5}  {:<19} {:>22} {:>22} {:>6}  {}\n", "level", "piece", "u", "v", "points", "then");
  for (size_t i = 0; i < path.steps.size(); ++i) {
    const LimitPath::Step& step = path.steps[i];
    std::string then;
    if (step.child >= 0)
      then = fmt::format("child {}", step.child);
    else if (path.end == LimitPath::End::polynomial)
      then = fmt::format("a polynomial of degree {}{}", path.degree, path.is_total ? "" : " in u and in v");
    else
      then = "a corner whose neighbourhood repeats itself: an eigenvector";
    if (step.times > 1) then += fmt::format(", {} times", step.times);
    text += fmt::format("{:>5}  {:<19} {:>22} {:>22} {:>6}  {}\n", step.level, step.piece, number(step.u),
                        number(step.v), step.num_points, then);
  }
  if (!path.spectrum.empty()) text += "eigenvalues at the corner: " + text_of(path.spectrum) + "\n";
  if (path.vertex >= 0)
    text += fmt::format("weights: those of the limit of vertex {} ({}), as `limit` has them\n", path.vertex, path.rule);
  const LimitStencil& stencil = path.stencil;
  double sum = 0, negative = 0;
  Eigen::RowVector3d point = Eigen::RowVector3d::Zero();
  text += fmt::format("status: {}\nweights of {} control points:\n", name(stencil.status), stencil.vertices.size());
  for (size_t i = 0; i < stencil.vertices.size(); ++i) {
    const double weight = stencil.weights(0, Eigen::Index(i));
    text += fmt::format("  vertex {:<8} {}\n", stencil.vertices[i], number(weight));
    point += weight * points.row(stencil.vertices[i]);
    sum += weight;
    negative += std::min(weight, 0.0);
  }
  text += fmt::format("their sum: {}; the negative ones: {}\n", number(sum), number(negative));
  text += fmt::format("point: {} {} {}\n", number(point[0]), number(point[1]), number(point[2]));
  return text;
}

}  // namespace sublimit::cli
