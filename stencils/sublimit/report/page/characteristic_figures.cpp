// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "sublimit/report/page/bands.h"
#include "sublimit/report/page/drawing.h"
#include "sublimit/report/page/figures.h"
#include "sublimit/report/page/map_net.h"
#include "sublimit/stencils/picture/picture.h"

namespace sublimit::page {
namespace {

/// Twice the signed area: its sign is the orientation of a face.
double turned(const MapNet& net, const std::vector<int>& face) {
  double sum = 0;
  for (std::size_t i = 0; i < face.size(); ++i) {
    const Point &a = net.points[face[i]], &b = net.points[face[(i + 1) % face.size()]];
    sum += a.x() * b.y() - a.y() * b.x();
  }
  return sum;
}

}  // namespace

Json characteristic_map_figure(const Json& neighborhood, const std::string& name) {
  const Json& map = at(neighborhood, "characteristic_map");
  const MapNet net = map_net(map);
  if (net.points.empty()) return {};
  std::vector<std::vector<Point>> lines;
  std::vector<Point> everything = net.points;
  for (const Json& polyline : at(map, "lines")) {
    lines.emplace_back();
    for (const Json& p : polyline) {
      lines.back().push_back({number(at(p, 0)).value_or(0), number(at(p, 1)).value_or(0)});
      everything.push_back(lines.back().back());
    }
  }
  const Fit fit = fit_points(everything, 380, 380, 14);
  svg::Path right, wrong, data;
  const auto add = [&](svg::Path& path, const std::vector<Point>& points, bool closed) {
    for (std::size_t i = 0; i < points.size(); ++i) {
      const svg::Spot at = svg::spot(fit.x(points[i]), fit.y(points[i]));
      i == 0 ? path.move(at) : path.line(at);
    }
    if (closed) path.close();
  };
  double total = 0;
  for (const std::vector<int>& face : net.faces) total += turned(net, face) > 0 ? 1 : -1;
  for (const std::vector<int>& face : net.faces) {
    std::vector<Point> corners;
    for (int v : face) corners.push_back(net.points[v]);
    add(turned(net, face) * total > 0 ? right : wrong, corners, true);
  }
  std::string body;
  if (!right.data().empty()) body += path(right.data(), "plus-soft net");
  if (!wrong.data().empty()) body += path(wrong.data(), "minus net");
  for (const std::vector<Point>& polyline : lines)
    if (polyline.size() > 1) add(data, polyline, false);
  if (!data.data().empty()) body += path(data.data(), "curve l0 thin");
  body += circle(fit.x(Point(0, 0)), fit.y(Point(0, 0)), 3, "plus");
  Legend items = {{swatch("plus-soft"), "positive"}};
  if (!wrong.data().empty()) items.emplace_back(swatch("minus"), "turned over");
  Json drawn =
      figure(drawing(fit.width, fit.height, "Characteristic map, " + name,
                     std::to_string(net.faces.size()) + " faces of its net and the images of parameter lines", body),
             items);
  drawn["lines"] = !lines.empty();
  return drawn;
}

Json eigenfunction_figure(const Json& neighborhood, const std::string& name) {
  const MapNet net = map_net(at(neighborhood, "characteristic_map"));
  if (net.faces.empty()) return {};
  double radius = 0;
  for (const Point& p : net.points) radius = std::max(radius, p.norm());
  std::vector<Panel> panels;
  for (const Json& f : at(neighborhood, "eigenfunctions")) {
    const std::vector<double> heights = heights_of(f, net);
    if (heights.empty() || panels.size() == 4) continue;
    double most = 0;
    for (double h : heights) most = std::max(most, std::abs(h));
    if (!(most > 0)) continue;
    PictureMesh mesh;
    mesh.positions.resize(static_cast<Eigen::Index>(heights.size()), 3);
    for (std::size_t v = 0; v < heights.size(); ++v)
      mesh.positions.row(static_cast<Eigen::Index>(v)) << net.points[v].transpose() / radius, .36 * heights[v] / most;
    for (const std::vector<int>& face : net.faces) {
      mesh.face_sizes.push_back(static_cast<Index>(face.size()));
      for (int v : face) mesh.face_vertices.push_back(v);
    }
    mesh.vertex_normals = soft_normals(mesh);
    std::vector<double> values = heights;
    for (double& h : values) h /= most;
    std::vector<PictureMesh> parts = bands(mesh, values, {-1e-6, 1e-6});
    parts[0].color = {.30, .53, .73}, parts[1].color = {.80, .78, .72}, parts[2].color = {.85, .50, .27};
    std::erase_if(parts, [](const PictureMesh& part) { return part.face_sizes.empty(); });
    const Json& value = at(f, "value");
    const double re = number(at(value, 0)).value_or(0), im = number(at(value, 1)).value_or(0);
    std::string caption = at(f, "block").is_null() ? "" : "block " + std::to_string(whole(at(f, "block"))) + ", ";
    caption += digits(re, 4) + (im != 0 ? (im > 0 ? " + " : " − ") + digits(std::abs(im), 4) + "i" : "");
    panels.push_back({parts, caption, {}});
  }
  if (panels.empty()) return {};
  PictureOptions options;
  options.panel_width = 180;
  options.panel_height = 128;
  options.columns = 2;
  options.caption_size = 12;
  options.up = {0, 0, 1};
  options.azimuth = .5;
  options.elevation = .75;
  options.sky_directions = 16;
  options.tone_step = 4;
  options.ground_shadow = false;
  options.plate = false;
  options.title = "Eigenfunctions, " + name;
  return figure(svg_picture(panels, options), {{swatch_of("#d9804a"), "above"}, {swatch_of("#4d87ba"), "below zero"}});
}

}  // namespace sublimit::page
