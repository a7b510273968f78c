// SPDX-License-Identifier: Apache-2.0
// The basis function, as a curve or as a surface.
#include <algorithm>
#include <cmath>

#include "sublimit/report/page/bands.h"
#include "sublimit/report/page/drawing.h"
#include "sublimit/report/page/figures.h"
#include "sublimit/report/page/map_net.h"
#include "sublimit/report/page/plane.h"
#include "sublimit/report/page/plot.h"
#include "sublimit/stencils/picture/picture.h"

namespace sublimit::page {
namespace {

std::vector<double> numbers(const Json& list) {
  std::vector<double> all;
  for (const Json& v : list) all.push_back(number(v).value_or(std::nan("")));
  return all;
}

Json basis_curve(const Json& basis, const std::string& scheme) {
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
  return figure(plot);
}

Json basis_surface(const Json& regular, const std::string& scheme) {
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
  Json drawn = figure(svg_picture({{parts, {}, {}}}, options));
  drawn["largest"] = most;
  return drawn;
}

}  // namespace

Json basis_figure(const Json& regular, const std::string& scheme) {
  return string(at(regular, "grid")) == "line" ? basis_curve(at(regular, "basis"), scheme)
                                               : basis_surface(regular, scheme);
}

}  // namespace sublimit::page
