// SPDX-License-Identifier: Apache-2.0
// Masks as diagrams: a disc at each point, with an area by its weight, and the weight as a fraction in or beside it.
#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <numeric>
#include <optional>

#include "sublimit/report/page/drawing.h"
#include "sublimit/report/page/figures.h"
#include "sublimit/report/page/plane.h"

namespace sublimit::page {
namespace {

struct Fraction {
  std::int64_t top = 0, bottom = 1;
};

/// Weights over a common denominator, as textbooks have them.
struct Common {
  std::int64_t denominator = 1;
  std::vector<std::int64_t> tops;
};

constexpr std::int64_t greatest_part = 1'000'000;

std::optional<std::int64_t> integer(std::string_view text) {
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || value > greatest_part || value < -greatest_part)
    return std::nullopt;
  return value;
}

/// Reads "9/64" or a whole number; absent for other exact numbers (cosines, roots) and for too many digits.
std::optional<Fraction> fraction(const std::string& text) {
  const std::size_t slash = text.find('/');
  const std::string_view all = text;
  const std::optional<std::int64_t> top = integer(all.substr(0, slash));
  const std::optional<std::int64_t> bottom = slash == std::string::npos ? 1 : integer(all.substr(slash + 1));
  if (!top || !bottom || *bottom <= 0) return std::nullopt;
  return Fraction{*top, *bottom};
}

/// Absent if an entry is not a fraction, or the denominator too large.
std::optional<Common> common_denominator(const Json& entries) {
  Common common;
  std::vector<Fraction> fractions;
  for (const Json& entry : entries) {
    const std::optional<Fraction> f = fraction(string(at(entry, "exact")));
    if (!f) return std::nullopt;
    fractions.push_back(*f);
    common.denominator = std::lcm(common.denominator, f->bottom);
    if (common.denominator > greatest_part) return std::nullopt;
  }
  for (const Fraction& f : fractions) common.tops.push_back(f.top * (common.denominator / f.bottom));
  return common;
}

const char* sign_css(double weight) { return weight > 0 ? "plus" : weight < 0 ? "minus" : "zero"; }

std::string signed_text(std::int64_t value) { return value < 0 ? "−" + std::to_string(-value) : std::to_string(value); }

/// Area of the disc grows with the weight; the least is still seen.
double radius_of(double weight, double greatest, double room) {
  return greatest > 0 ? std::max(2.5, room * std::sqrt(std::abs(weight) / greatest)) : 2;
}

/// Do so many letters fit into a disc?
bool fits(std::size_t letters, double radius) { return 7.4 * static_cast<double>(letters) + 4 < 2 * radius; }

std::string label(double x, double y, double radius, const std::string& words, std::size_t letters) {
  if (fits(letters, radius)) return text(x, y + 4, words, {"middle", "on"});
  return text(x, y + radius + 11, words, {"middle", "small"});
}

const Legend signs = {{circle(11, 6, 4.5, "plus"), "positive"}, {circle(11, 6, 4.5, "minus"), "negative"}};

}  // namespace

Json regular_mask_figure(const Json& regular, const std::string& scheme) {
  const Json& mask = at(regular, "mask");
  if (!mask.is_array() || mask.empty()) return {};
  const std::string grid = grid_of(regular);
  const double unit = number(at(regular, "unit")).value_or(1);
  const std::optional<Common> common = common_denominator(mask);
  std::vector<Point> points;
  double greatest = 0;
  for (const Json& entry : mask) {
    const Json& where = at(entry, "at");
    points.push_back(on_grid(grid, unit * number(at(where, 0)).value_or(0), unit * number(at(where, 1)).value_or(0)));
    greatest = std::max(greatest, std::abs(number(at(entry, "weight")).value_or(0)));
  }
  const Fit fit = fit_points(points, 380, grid == "line" ? 90 : 360, 30);
  const double room = .44 * std::min(60., unit * fit.scale);
  std::string body;
  for (std::size_t i = 0; i < points.size(); ++i) {  // the grid: segments between neighbours
    for (std::size_t j = 0; j < i; ++j) {
      const double length = (points[i] - points[j]).norm();
      if (length < unit * 1.01)
        body += line(fit.x(points[i]), fit.y(points[i]), fit.x(points[j]), fit.y(points[j]), "grid");
    }
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double weight = number(at(mask[i], "weight")).value_or(0), x = fit.x(points[i]), y = fit.y(points[i]);
    const double radius = radius_of(weight, greatest, room);
    const std::string words = common ? signed_text(common->tops[i]) : digits(weight, 3);
    body += circle(x, y, radius, sign_css(weight), escaped(string(at(mask[i], "exact"), digits(weight, 6))));
    body += label(x, y, radius, words, words.size() - (words[0] == '\xe2' ? 2 : 0));
  }
  Json drawn = figure(drawing(fit.width, fit.height, "Mask of " + scheme + " on the regular grid",
                              std::to_string(mask.size()) + " weights", body),
                      signs);
  if (common) drawn["times"] = common->denominator;
  return drawn;
}

Json support_figure(const Json& regular, const std::string& scheme) {
  const Json& support = at(regular, "support");
  const Json& outline = at(support, "outline");
  const std::string grid = grid_of(regular);
  if (grid == "line" || !outline.is_array() || outline.size() < 3) return {};
  std::vector<Point> corners, lattice;
  double extent = 1;
  for (const Json& p : outline) {
    const double u = number(at(p, 0)).value_or(0), v = number(at(p, 1)).value_or(0);
    corners.push_back(on_grid(grid, u, v));
    extent = std::max({extent, std::abs(u), std::abs(v)});
  }
  const int reach = static_cast<int>(std::min(12., std::ceil(extent - 1e-9)));
  const Fit fit = fit_points(corners, 380, 340, 34);
  std::string body = path(path_data(fit.all(corners), true), "area");
  const auto segment = [&](int i, int j, int di, int dj) {
    const Point a = on_grid(grid, i, j), b = on_grid(grid, i + di, j + dj);
    if (inside(corners, .5 * (a + b) * .9999)) body += line(fit.x(a), fit.y(a), fit.x(b), fit.y(b), "lattice");
  };
  for (int i = -reach; i <= reach; ++i) {
    for (int j = -reach; j <= reach; ++j) {
      segment(i, j, 1, 0);
      segment(i, j, 0, 1);
      if (grid == "triangular") segment(i, j, 1, 1);
      if (grid == "triangular-") segment(i, j, -1, 1);
    }
  }
  body += circle(fit.x(Point(0, 0)), fit.y(Point(0, 0)), 5, "plus");
  return figure(
      drawing(fit.width, fit.height, "Support of the basis function of " + scheme, string(at(support, "text")), body));
}

namespace {

Json mask_figure(const Json& neighborhood, const Json& mask, const std::string& title) {
  if (!mask.is_array() || mask.empty()) return {};
  // The first and the last spoke of an open neighbourhood are two: its sectors fill half a turn.
  const std::string kind = string(at(neighborhood, "kind"));
  const bool is_open = kind == "border" || kind == "crease" || kind == "corner";
  const double turn = (is_open ? 1 : 2) * std::numbers::pi / std::max(1, whole(at(neighborhood, "n"), 4));
  std::vector<Point> points;
  double greatest = 0;
  for (const Json& entry : mask) {
    points.push_back(at_label(at(entry, "label"), turn));
    greatest = std::max(greatest, std::abs(number(at(entry, "weight")).value_or(0)));
  }
  if (greatest <= 0) return {};
  std::vector<Point> shown = points;
  shown.emplace_back(0, 0);  // where the spokes meet
  const Fit fit = fit_points(shown, 380, 330, 36);
  double nearest = 1e9;  // between the points that show
  for (std::size_t i = 0; i < points.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) nearest = std::min(nearest, (points[i] - points[j]).norm() * fit.scale);
  const double room = std::clamp(.46 * nearest, 3., 22.);
  std::string body;
  for (const Point& p : points) body += line(fit.x(Point(0, 0)), fit.y(Point(0, 0)), fit.x(p), fit.y(p), "grid");
  body += '\n';
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Json& entry = mask[i];
    const double weight = number(at(entry, "weight")).value_or(0), x = fit.x(points[i]), y = fit.y(points[i]);
    const std::string exact = string(at(entry, "exact")), decimal = digits(weight, 3);
    const double radius = radius_of(weight, greatest, room);
    body += circle(x, y, radius, sign_css(weight), escaped(exact.empty() ? digits(weight, 8) : exact));
    const std::string words = !exact.empty() && exact.size() <= 6 ? escaped(exact) : decimal;
    const double letters = static_cast<double>(words.size());
    if (fits(words.size(), radius)) {
      body += text(x, y + 4, words, {"middle", "on"});
    } else if (nearest > 30 && 5.6 * letters < 1.1 * nearest) {
      body += text(x, y + radius + 10, words, {"middle", "small"});
    }
  }
  return figure(drawing(fit.width, fit.height, title, "", body));
}

}  // namespace

void add_mask_figures(const Json& neighborhood, const std::string& name, Json& figures) {
  for (const auto& [key, title] :
       {std::pair{"position", "Limit position, "}, {"tangent1", "First tangent, "}, {"tangent2", "Second tangent, "}})
    figures[key] = mask_figure(neighborhood, at(at(neighborhood, "masks"), key), title + name);
}

}  // namespace sublimit::page
