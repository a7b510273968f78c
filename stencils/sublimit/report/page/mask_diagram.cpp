// SPDX-License-Identifier: Apache-2.0
#include "sublimit/report/page/mask_diagram.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>

#include "sublimit/report/page/drawing.h"
#include "sublimit/report/page/exact.h"
#include "sublimit/report/page/plane.h"

namespace sublimit::page {
namespace {

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

std::string signs_legend() {
  return legend({{circle(11, 6, 4.5, "plus"), "positive"}, {circle(11, 6, 4.5, "minus"), "negative"}});
}

}  // namespace

std::string regular_mask_figure(const Json& regular, const std::string& scheme) {
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
  std::string caption = signs_legend() + "<b>The mask.</b> ";
  if (common && common->denominator > 1) {
    caption += "Weights times " + std::to_string(common->denominator) + ". ";
  } else {
    caption += "Areas are proportional to weights. ";
  }
  caption +=
      "One control point spreads these parts of itself over the points of the next level; the stencils of the "
      "scheme are every " +
      (whole(at(regular, "dilation"), 2) == 3 ? std::string("third") : std::string("second")) + " entry.";
  return figure(drawing(fit.width, fit.height, "Mask of " + scheme + " on the regular grid",
                        std::to_string(mask.size()) + " weights", body),
                caption);
}

std::string support_figure(const Json& regular, const std::string& scheme) {
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
      drawing(fit.width, fit.height, "Support of the basis function of " + scheme, string(at(support, "text")), body),
      "<b>Support.</b> " + prose(at(support, "text")) +
          ". What the control point in the middle can move, in the control mesh.");
}

namespace {

struct MaskSpec {
  const Json& mask;
  const char* title;
  const char* caption;
};

std::string mask_figure(const Json& neighborhood, const MaskSpec& spec, const std::string& name) {
  if (!spec.mask.is_array() || spec.mask.empty()) return {};
  // The first and the last spoke of an open neighbourhood are two: its sectors fill half a turn.
  const std::string kind = string(at(neighborhood, "kind"));
  const bool is_open = kind == "border" || kind == "crease" || kind == "corner";
  const double turn = (is_open ? 1 : 2) * std::numbers::pi / std::max(1, whole(at(neighborhood, "n"), 4));
  std::vector<Point> points;
  double greatest = 0;
  for (const Json& entry : spec.mask) {
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
    const Json& entry = spec.mask[i];
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
  return figure(drawing(fit.width, fit.height, std::string(spec.title) + ", " + name, "", body),
                std::string("<b>") + spec.title + ".</b> " + spec.caption);
}

std::string label_text(const Json& label) {
  std::string text = "(";
  for (std::size_t i = 0; i < 3; ++i) text += (i > 0 ? ", " : "") + shown(at(label, i));
  return text + ")";
}

}  // namespace

std::string neighborhood_masks(const Json& neighborhood, const std::string& name) {
  const Json& masks = at(neighborhood, "masks");
  if (masks.is_null()) return {};
  const MaskSpec specs[3] = {
      {at(masks, "position"), "Limit position", "The limit of the point in the middle is this mean."},
      {at(masks, "tangent1"), "First tangent", "Weights of the derivative along the first spoke, up to its length."},
      {at(masks, "tangent2"), "Second tangent", "The other tangent; their cross product is the normal."}};
  std::string all, tables;
  std::map<std::string, std::vector<std::string>> rows;  // by label: what the masks have there
  std::vector<std::string> order;
  for (int m = 0; m < 3; ++m) {
    all += mask_figure(neighborhood, specs[m], name);
    for (const Json& entry : specs[m].mask) {
      const std::string key = label_text(at(entry, "label"));
      auto [row, fresh] = rows.try_emplace(key, 4, std::string(dash));
      if (fresh) order.push_back(key), row->second[0] = key;
      const std::string exact = string(at(entry, "exact"));
      row->second[m + 1] = shown(at(entry, "weight"), 8);
      if (!exact.empty()) row->second[m + 1] += " = <span class=\"code\">" + escaped(exact) + "</span>";
    }
  }
  if (all.empty()) return {};
  Table table{
      "Limit masks by label (sector, x, y)", {"point", "position", "first tangent", "second tangent"}, {}, "numbers"};
  for (const std::string& key : order) table.rows.push_back(rows[key]);
  return "<h4>Limit masks</h4>\n" + figures(all) + signs_legend() +
         "<details class=\"inner\"><summary>The weights as numbers</summary>" + html(table) + "</details>\n";
}

}  // namespace sublimit::page
