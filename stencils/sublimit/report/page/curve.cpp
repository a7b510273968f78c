// SPDX-License-Identifier: Apache-2.0
// Piecewise curves.
#include "sublimit/report/page/drawing.h"
#include "sublimit/report/page/figures.h"
#include "sublimit/report/page/plane.h"

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

}  // namespace

Json curve_figure(const Json& curve) {
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
  return figure(drawing(fit.width, fit.height, "The curve, its pieces in turn in two colours", "", body));
}

}  // namespace sublimit::page
