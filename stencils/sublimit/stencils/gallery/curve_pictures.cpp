// SPDX-License-Identifier: Apache-2.0
#include "sublimit/stencils/gallery/curve_pictures.h"

#include <algorithm>

#include "sublimit/curves/curve_refine.h"
#include "sublimit/curves/schemes/curve_schemes.h"
#include "sublimit/geometric/geometric_schemes.h"
#include "sublimit/stencils/picture/picture.h"

namespace sublimit::gallery {
namespace {

struct NamedPolygon {
  std::string name, title;
  ControlPolygon polygon;
};

/// For schemes that take derivatives: half the way from the point before to the one behind.
void add_tangents(ControlPolygon& polygon) {
  const Index n = polygon.num_points();
  const bool closed = polygon.curves[0].closed;
  polygon.tangents.resize(n, 2);
  for (Index i = 0; i < n; ++i) {
    const Index before = closed ? (i + n - 1) % n : std::max(i - 1, 0),
                behind = closed ? (i + 1) % n : std::min(i + 1, n - 1);
    polygon.tangents.row(i) = (polygon.points.row(behind) - polygon.points.row(before)) / 2;
  }
}

std::vector<NamedPolygon> polygons() {
  Points open(7, 2), closed(7, 2);
  open << 0, 0, .8, 2.6, 2, 2.6, 2.6, .4, 3.6, .4, 4.4, 2.8, 5.6, 1.2;
  closed << 0, 0, 2.4, .7, 5, 0, 4.4, 2, 5, 3.4, 2.2, 2.3, .3, 3.4;
  std::vector<NamedPolygon> both{{"open", "Open polygon", polygon_through(open)},
                                 {"closed", "Closed polygon", polygon_through(closed, true)}};
  for (NamedPolygon& named : both) add_tangents(named.polygon);
  return both;
}

/// A scheme's row.
struct Shown {
  std::string scheme, source, limit, smoothness;
  bool interpolates = false;
  std::vector<Points> levels;
};

std::vector<Shown> shown(const ControlPolygon& polygon, int levels) {
  std::vector<Shown> all;
  for (const CurveScheme<double>& scheme : all_curve_schemes()) {
    const CurveClaims& claims = scheme.claims;
    Shown one{scheme.name, scheme.source, claims.limit, "C^" + std::to_string(claims.regular), claims.interpolates, {}};
    Points x = unknowns(scheme, polygon);
    for (const CurveLevel& level : refine(scheme, polygon, levels)) {
      x = level.S * x;
      one.levels.push_back(refined_polygon(level, x).points);
    }
    all.push_back(std::move(one));
  }
  ControlPolygon unit = polygon;
  unit.tangents.rowwise().normalize();
  for (const GeometricCurveScheme& scheme : all_geometric_schemes()) {
    const GeometricClaims& claims = scheme.claims;
    Shown one{scheme.name,         scheme.source,
              claims.limit,        "G^" + std::to_string(claims.regular.value_or(0)),
              claims.interpolates, {}};
    for (int k = 0; k <= levels; ++k) one.levels.push_back(refine(scheme, unit, k).points);
    all.push_back(std::move(one));
  }
  return all;
}

Points in_space(const Points& plane) {
  Points points = Points::Zero(plane.rows(), 3);
  points.leftCols(2) = plane;
  return points;
}

/// A polygon with dots at its points.
void draw(const Points& points, bool closed, const Color& color, double width, double dots, Panel& panel) {
  Strokes lines(color, width), marks(color, dots);
  lines.polyline(points);
  if (closed) lines.line(static_cast<Index>(points.rows()) - 1, 0);
  for (Eigen::Index i = 0; i < points.rows(); ++i) marks.dot(points.row(i));
  panel.layers.push_back(lines.mesh());
  panel.layers.push_back(marks.mesh());
}

/// A panel a level: the control polygon in grey, the level over it.
std::vector<Panel> panels(const Shown& shown, const ControlPolygon& polygon) {
  constexpr Color grey{.73, .71, .66}, blue{.20, .40, .54}, brown{.60, .44, .27};
  const bool closed = polygon.curves[0].closed;
  std::vector<Panel> all;
  for (size_t k = 0; k < shown.levels.size(); ++k) {
    Panel& panel = all.emplace_back();
    panel.caption = "level " + std::to_string(k);
    panel.note = std::to_string(shown.levels[k].rows()) + " points";
    draw(in_space(polygon.points), closed, grey, 1.1, 5, panel);
    draw(in_space(shown.levels[k]), closed, shown.interpolates ? brown : blue, 1.8,
         k < 2    ? 4.6
         : k == 2 ? 3.8
                  : 3,
         panel);
  }
  return all;
}

/// The plane onto the paper: the same for all schemes of a polygon.
PictureOptions view_of(const std::vector<Shown>& all) {
  PictureOptions options;
  options.panel_width = 230;
  options.panel_height = 170;
  options.caption_size = 13;
  options.azimuth = options.elevation = options.distance = 0;
  options.ground_shadow = false;
  Eigen::RowVector2d low = Eigen::RowVector2d::Constant(1e300), high = -low;
  for (const Shown& one : all)
    for (const Points& level : one.levels) {
      low = low.cwiseMin(level.colwise().minCoeff());
      high = high.cwiseMax(level.colwise().maxCoeff());
    }
  options.in_view = Points::Zero(2, 3);
  options.in_view.row(0).head(2) = low;
  options.in_view.row(1).head(2) = high;
  return options;
}

}  // namespace

GalleryPart curve_pictures(int levels) {
  GalleryPart result;
  for (const NamedPolygon& named : polygons()) {
    const std::vector<Shown> all = shown(named.polygon, levels);
    const PictureOptions view = view_of(all);
    Json rows = Json::array();
    for (const Shown& one : all) {
      const std::string file = one.scheme + "-" + named.name + ".svg";
      result.files.push_back({file, svg_picture(panels(one, named.polygon), view)});
      rows.push_back({{"name", one.scheme},
                      {"source", one.source},
                      {"numbers", {{"limit", one.limit}, {"smoothness", one.smoothness}}},
                      {"picture", file}});
    }
    result.rows.push_back({{"id", named.name}, {"title", named.title}, {"rows", rows}});
  }
  return result;
}

}  // namespace sublimit::gallery
