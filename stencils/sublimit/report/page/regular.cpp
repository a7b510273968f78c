// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "sublimit/report/page/bands.h"
#include "sublimit/report/page/drawing.h"
#include "sublimit/report/page/map_net.h"
#include "sublimit/report/page/mask_diagram.h"
#include "sublimit/report/page/plane.h"
#include "sublimit/report/page/plot.h"
#include "sublimit/report/page/sections.h"
#include "sublimit/report/page/verdicts.h"
#include "sublimit/stencils/picture/picture.h"

namespace sublimit::page {
namespace {

std::vector<double> numbers(const Json& list) {
  std::vector<double> all;
  for (const Json& v : list) all.push_back(number(v).value_or(std::nan("")));
  return all;
}

std::string basis_curve(const Json& basis, const std::string& scheme) {
  const std::vector<double> x = numbers(at(basis, "x"));
  Plot plot{"Basis function of " + scheme, "", "parameter", "value"};
  const auto add = [&](const Json& values, const char* name, int kind) {
    const Json& row = at(values, 0).is_array() ? at(values, 0) : values;
    Series s{name, {}, kind, false};
    s.faint = kind > 0;
    for (std::size_t i = 0; i < x.size(); ++i) s.points.emplace_back(x[i], number(at(row, i)));
    plot.series.push_back(std::move(s));
  };
  add(at(basis, "values"), "basis function", 0);
  if (at(basis, "derivative").is_array()) add(at(basis, "derivative"), "derivative", 1);
  return figure(plot, "<b>The basis function</b>, the limit of one control point at height one.");
}

std::string basis_surface(const Json& regular, const std::string& scheme) {
  const Json& basis = at(regular, "basis");
  const std::string grid = grid_of(regular);
  const std::vector<double> x = numbers(at(basis, "x")), y = numbers(at(basis, "y"));
  const Json& values = at(basis, "values");
  const std::size_t width = x.size(), height = y.size();
  if (width < 2 || height < 2 || values.size() != height) return {};
  PictureMesh mesh;
  mesh.positions.resize(static_cast<Eigen::Index>(width * height), 3);
  std::vector<bool> outside(width * height);
  double most = 0, extent = 0;
  for (std::size_t j = 0; j < height; ++j) {
    for (std::size_t i = 0; i < width; ++i) {
      const std::optional<double> value = number(at(at(values, j), i));
      const Point p = on_grid(grid, x[i], y[j]);
      mesh.positions.row(static_cast<Eigen::Index>(j * width + i)) << p.x(), p.y(), value.value_or(0);
      most = std::max(most, std::abs(value.value_or(0)));
      outside[j * width + i] = !value || *value == 0;
    }
  }
  if (!mesh.positions.allFinite()) return {};
  for (std::size_t j = 0; j + 1 < height; ++j) {
    for (std::size_t i = 0; i + 1 < width; ++i) {
      const std::size_t a = j * width + i, b = a + 1, c = a + 1 + width, d = a + width;
      if (outside[a] && outside[b] && outside[c] && outside[d]) continue;  // beyond the support
      mesh.face_sizes.push_back(4);
      for (std::size_t v : {a, b, c, d}) {
        mesh.face_vertices.push_back(static_cast<Index>(v));
        extent = std::max(extent, mesh.positions.row(static_cast<Eigen::Index>(v)).head(2).cwiseAbs().maxCoeff());
      }
    }
  }
  if (mesh.face_sizes.empty() || !(most > 0)) return {};
  mesh.positions.col(2) *= .75 * extent / most;
  mesh.vertex_normals = soft_normals(mesh);
  std::vector<double> heights(width * height);
  for (std::size_t v = 0; v < heights.size(); ++v)
    heights[v] = mesh.positions(static_cast<Eigen::Index>(v), 2) / extent;
  std::vector<PictureMesh> parts = bands(mesh, heights, {-1e-6});
  parts[0].color = {.80, .45, .22};
  std::erase_if(parts, [](const PictureMesh& part) { return part.face_sizes.empty(); });
  PictureOptions options;
  options.panel_width = 360;
  options.panel_height = 250;
  options.up = {0, 0, 1};
  options.azimuth = .5;
  options.elevation = .42;
  options.sky_directions = 24;
  options.tone_step = 2;
  options.ground_shadow = false;
  options.plate = false;
  options.title = "Basis function of " + scheme;
  return figure(svg_picture({{parts, {}, {}}}, options),
                "<b>The basis function</b>, the limit of one control point at height one; largest value " +
                    shown(most, 4) + ". Brown, where there is some: below zero.");
}

/// An interval of exponents over whole numbers: what is known from below and from above.
std::string exponent_figure(const Json& smoothness, const std::string& scheme) {
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
  return figure(
      drawing(380, 88, "Hoelder exponent of " + scheme, "", body),
      "<b>Hölder exponent</b>, enclosed from below by norms of differences, from above by products of matrices. "
      "Beyond a whole number <i>k</i> the limit is C<sup><i>k</i></sup>." +
          (string(at(smoothness, "notes")).empty() ? "" : " " + prose(at(smoothness, "notes"))));
}

std::string criteria(const Json& list) {
  if (!list.is_object()) return {};
  std::vector<std::pair<std::string, std::string>> items;
  for (const char* key : {"efficiency", "support", "locality", "simplicity", "continuity"})
    items.emplace_back(std::string(1, static_cast<char>(key[0] - 'a' + 'A')) + (key + 1), prose(at(list, key)));
  return "<h4>The five usual criteria</h4>\n" + facts(items);
}

std::string norms(const Json& regular) {
  const Json& list = at(regular, "norms");
  std::string text;
  if (list.is_array() && !list.empty()) {
    Table table{"Norms of the schemes of differences; below one they contract",
                {"order", "steps", "norm", "enclosure"},
                {},
                "numbers"};
    for (const Json& n : list) {
      const Json& e = at(n, "enclosure");
      table.rows.push_back({shown(at(n, "order")), shown(at(n, "steps")), shown(at(n, "norm"), 7),
                            e.is_array() ? "[" + literal(at(e, 0)) + ", " + literal(at(e, 1)) + "]" : literal(e)});
    }
    text += html(table);
  }
  const Json& radius = at(regular, "joint_spectral_radius");
  if (radius.is_object()) {
    text += "<p>Joint spectral radius of the transition matrices";
    if (!at(radius, "order").is_null()) text += " of differences of order " + shown(at(radius, "order"));
    text += ": between " + shown(at(radius, "low"), 8) + " (a product of " + shown(at(radius, "products")) + ") and " +
            shown(at(radius, "high"), 8);
    if (whole(at(radius, "vertices")) > 0)
      text += " (a polytope of " + shown(at(radius, "vertices")) + " pairs of vertices)";
    text += ".</p>\n";
  }
  return text;
}

}  // namespace

std::string regular_part(const Json& regular, const std::string& scheme) {
  if (!regular.is_object()) return {};
  const Json &degrees = at(regular, "degrees"), &operations = at(regular, "operations");
  const Json& continuity = at(at(regular, "smoothness"), "continuity");
  std::string kinds;
  for (const Json& k : at(operations, "by_kind"))
    kinds += (kinds.empty() ? "" : ", ") + literal(at(k, "kind")) + " " + shown(at(k, "points"));
  std::string text =
      "<h3>On regular " + std::string(string(at(regular, "grid")) == "line" ? "polygons" : "meshes") + "</h3>\n";
  text += facts({{"Continuity", continuity.is_null() ? dash : "C<sup>" + shown(continuity) + "</sup>"},
                 {"Polynomials generated",
                  at(degrees, "generates").is_null() ? dash : "up to degree " + shown(at(degrees, "generates"))},
                 {"Polynomials reproduced",
                  at(degrees, "reproduces").is_null() ? dash : "up to degree " + shown(at(degrees, "reproduces"))},
                 {"Approximation order", shown(at(degrees, "approximation_order"))},
                 {"Points per new point", shown(at(operations, "per_new_point"), 4) +
                                              (kinds.empty() ? "" : " <span class=\"quiet\">(" + kinds + ")</span>")}});
  const std::string basis = string(at(regular, "grid")) == "line" ? basis_curve(at(regular, "basis"), scheme)
                                                                  : basis_surface(regular, scheme);
  text += figures(regular_mask_figure(regular, scheme) + basis + support_figure(regular, scheme) +
                  exponent_figure(at(regular, "smoothness"), scheme));
  text += criteria(at(regular, "criteria"));
  text += verdicts(at(regular, "verdicts"));
  return text + norms(regular);
}

}  // namespace sublimit::page
