// SPDX-License-Identifier: Apache-2.0
#include "sublimit/report/page/plot.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sublimit/report/page/drawing.h"

namespace sublimit::page {
namespace {

/// Pixels of an axis: linear in a value or in its logarithm.
struct Axis {
  double low = 0, high = 1, from = 0, to = 1;
  bool log = false;
  double scaled(double v) const { return log ? std::log10(v) : v; }
  double operator()(double v) const {
    return from + (scaled(v) - scaled(low)) / (scaled(high) - scaled(low)) * (to - from);
  }
};

struct Range {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  void add(double v) { low = std::min(low, v), high = std::max(high, v); }
  bool empty() const { return low > high; }
};

std::vector<double> powers_of_ten(double low, double high) {
  std::vector<double> all;
  const int first = static_cast<int>(std::ceil(std::log10(low) - 1e-9)),
            last = static_cast<int>(std::floor(std::log10(high) + 1e-9));
  const int step = std::max(1, (last - first + 5) / 6);
  for (int e = first; e <= last; e += step) all.push_back(std::pow(10., e));
  return all;
}

Axis axis_of(Range range, bool log, bool zero) {
  if (zero) range.add(0);
  if (log) {
    range.low = std::pow(10., std::floor(std::log10(range.low) - 1e-9));
    range.high = std::pow(10., std::ceil(std::log10(range.high) + 1e-9));
    return {range.low, range.high, 0, 1, true};
  }
  const double span = range.high - range.low;
  const double margin = span > 0 ? .06 * span : std::max(.5 * std::abs(range.high), .5);
  return {zero && range.low >= 0 ? 0 : range.low - margin, range.high + margin, 0, 1, false};
}

}  // namespace

std::vector<double> ticks(double low, double high, int about) {
  const double span = high - low;
  if (!(span > 0) || !std::isfinite(span)) return {low};
  const double raw = span / about, power = std::pow(10., std::floor(std::log10(raw)));
  double step = power;
  for (double factor : {1., 2., 5., 10.}) {
    step = factor * power;
    if (step >= raw * (1 - 1e-9)) break;
  }
  std::vector<double> all;
  for (double i = std::ceil(low / step - 1e-9); i * step <= high + 1e-9 * step; ++i) all.push_back(i * step);
  return all;
}

Json figure(const Plot& plot) {
  Range xs, ys;
  for (const Series& s : plot.series) {
    for (const auto& [x, y] : s.points) {
      xs.add(x);
      if (y && (!plot.log_y || *y > 0)) ys.add(*y);
    }
  }
  if (xs.empty() || ys.empty()) return {};
  for (const Plot::Rule& rule : plot.rules)
    if (!plot.log_y || rule.y > 0) ys.add(rule.y);

  const double left = 46, right = 14, top = 30, bottom = 38;
  Axis x = axis_of(xs, false, false), y = axis_of(ys, plot.log_y, plot.zero_y);
  if (plot.whole_x) x.low = xs.low - .5, x.high = xs.high + .5;
  x.from = left, x.to = plot.width - right;
  y.from = plot.height - bottom, y.to = top;

  std::string body;
  const std::vector<double> y_ticks = plot.log_y ? powers_of_ten(y.low, y.high) : ticks(y.low, y.high, 5);
  for (double v : y_ticks) {
    body += line(x.from, y(v), x.to, y(v), "grid");
    body += text(x.from - 6, y(v) + 4, digits(std::abs(v) < 1e-12 ? 0 : v, 4), {"end", "quiet"});
  }
  std::vector<double> x_ticks = ticks(plot.whole_x ? xs.low : x.low, plot.whole_x ? xs.high : x.high, 7);
  if (plot.whole_x) {
    x_ticks.clear();
    const double step = std::max(1., std::ceil((xs.high - xs.low) / 14));
    for (double v = std::ceil(xs.low); v <= xs.high; v += step) x_ticks.push_back(v);
  }
  for (double v : x_ticks) {
    body += line(x(v), y.from, x(v), y.from + 4, "frame");
    body += text(x(v), y.from + 17, digits(std::abs(v) < 1e-12 ? 0 : v, 4), {"middle", "quiet"});
  }
  body += line(x.from, y.from, x.to, y.from, "frame");
  body += text(x.from - 40, 16, escaped(plot.y_name), {"start", "quiet"});
  body += text(x.to, plot.height - 5, escaped(plot.x_name), {"end", "quiet"});
  body += '\n';
  for (const Plot::Rule& rule : plot.rules) {
    if (plot.log_y && rule.y <= 0) continue;
    body += line(x.from, y(rule.y), x.to, y(rule.y), "rule");
    body += text(x.to, y(rule.y) - 5, escaped(rule.name), {"end", nullptr});
  }

  Legend names;
  for (const Series& s : plot.series) {
    const std::string css = s.dashed ? "rule" : "curve l" + std::to_string(s.kind % 8) + (s.faint ? " faint" : "");
    if (s.line) {
      svg::Path data;
      bool drawing = false;
      for (std::size_t i = 0; i < s.points.size(); ++i) {
        const auto& [px, py] = s.points[i];
        const bool here = py && (!plot.log_y || *py > 0);
        if (here) {
          const svg::Spot spot = svg::spot(x(px), y(*py));
          drawing ? data.line(spot) : data.move(spot);
        }
        drawing = here;
      }
      if (!data.data().empty()) body += path(data.data(), css);
    }
    if (s.marks)
      for (const auto& [px, py] : s.points)
        if (py && (!plot.log_y || *py > 0)) body += mark(s.kind, x(px), y(*py), s.faint ? 3.2 : 3.6);
    if (s.name.empty()) continue;
    std::string sign;
    if (s.line) sign += line(1, 6, 21, 6, css.c_str());
    if (s.marks) sign += mark(s.kind, 11, 6, s.faint ? 3.2 : 3.6);
    names.emplace_back(sign, s.name);
  }
  return figure(drawing(plot.width, plot.height, plot.title, plot.description, body), names);
}

}  // namespace sublimit::page
