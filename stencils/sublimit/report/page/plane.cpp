// SPDX-License-Identifier: Apache-2.0
#include "sublimit/report/page/plane.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace sublimit::page {

std::string grid_of(const Json& regular) {
  const std::string grid = string(at(regular, "grid"), "square");
  if (grid != "triangular") return grid;
  double skew = 0;  // a mask with equilateral symmetry is spread along the third direction
  for (const Json& entry : at(regular, "mask")) {
    const Json& where = at(entry, "at");
    skew +=
        number(at(entry, "weight")).value_or(0) * number(at(where, 0)).value_or(0) * number(at(where, 1)).value_or(0);
  }
  return skew < 0 ? "triangular-" : grid;
}

Point on_grid(const std::string& grid, double u, double v) {
  if (grid == "line") return {u, 0};
  if (grid == "triangular-") return {u + .5 * v, .5 * std::numbers::sqrt3 * v};
  if (grid == "triangular") return {u - .5 * v, .5 * std::numbers::sqrt3 * v};
  return {u, v};
}

Point at_label(const Json& label, double turn) {
  const double sector = number(at(label, 0)).value_or(0);
  const double x = number(at(label, 1)).value_or(0), y = number(at(label, 2)).value_or(0);
  const auto spoke = [&](double s) { return Point(std::cos(turn * s), std::sin(turn * s)); };
  const Point p = x * spoke(sector) + y * spoke(sector + 1);
  // With few spokes the diagonal points would come too near the centre, with many too far out: keep some of the ring.
  const double ring = std::max(x, y), r = p.norm();
  if (r < 1e-12 || ring <= 0) return p;
  return p / r * (.25 * r + .75 * (ring + .35 * std::min(x, y)));
}

std::vector<std::pair<double, double>> Fit::all(const std::vector<Point>& points) const {
  std::vector<std::pair<double, double>> spots;
  for (const Point& p : points) spots.emplace_back(x(p), y(p));
  return spots;
}

Fit fit_points(const std::vector<Point>& points, double width, double most_height, double margin) {
  Point low(0, 0), high(0, 0);
  bool first = true;
  for (const Point& p : points) {
    low = first ? p : low.cwiseMin(p).eval();
    high = first ? p : high.cwiseMax(p).eval();
    first = false;
  }
  const Point size = high - low;
  Fit fit;
  fit.width = width;
  fit.middle = .5 * (low + high);
  const double horizontal = (width - 2 * margin) / std::max(size.x(), 1e-300);
  const double vertical = (most_height - 2 * margin) / std::max(size.y(), 1e-300);
  fit.scale = std::min(horizontal, vertical);
  if (!(fit.scale < 1e200)) fit.scale = 1;
  fit.height = std::min(most_height, fit.scale * size.y() + 2 * margin);
  return fit;
}

bool inside(const std::vector<Point>& polygon, const Point& p) {
  bool in = false;
  for (std::size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++) {
    const Point &a = polygon[i], &b = polygon[j];
    if ((a.y() > p.y()) != (b.y() > p.y()) && p.x() < (b.x() - a.x()) * (p.y() - a.y()) / (b.y() - a.y()) + a.x())
      in = !in;
  }
  return in;
}

}  // namespace sublimit::page
