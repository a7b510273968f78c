// SPDX-License-Identifier: Apache-2.0
#include "sublimit/stencils/gallery/curve_pictures.h"

#include <algorithm>

#include "sublimit/curves/curve_refine.h"
#include "sublimit/curves/schemes/curve_schemes.h"
#include "sublimit/geometric/geometric_schemes.h"
#include "sublimit/stencils/picture/svg.h"

namespace sublimit::gallery {
namespace {

using svg::escaped;
using svg::pixels;

constexpr double panel_width = 230, panel_height = 170, border = 14, margin = 16, caption_height = 44;

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

/// The plane onto the paper: the same for all schemes of a polygon.
struct View {
  Eigen::Array2d low = Eigen::Array2d::Constant(1e300), high = -low;

  void extend(const Points& points) {
    low = low.min(points.colwise().minCoeff().transpose().array());
    high = high.max(points.colwise().maxCoeff().transpose().array());
  }
  svg::Spot spot(const Eigen::RowVector2d& p) const {
    const Eigen::Array2d room(panel_width - 2 * margin, panel_height - 2 * margin);
    const double scale = (room / (high - low)).minCoeff();
    const Eigen::Array2d at = (p.transpose().array() - (low + high) / 2) * scale;
    return svg::spot(panel_width / 2 + at.x(), panel_height / 2 - at.y());
  }
};

std::string stroke(const Points& points, bool closed, const View& view, const char* style) {
  svg::Path path;
  path.move(view.spot(points.row(0)));
  for (Eigen::Index i = 1; i < points.rows(); ++i) path.line(view.spot(points.row(i)));
  if (closed) path.close();
  return std::string("<path fill=\"none\" ") + style + " d=\"" + path.data() + "\"/>\n";
}

std::string dots(const Points& points, const View& view, const char* style) {
  svg::Path path;
  for (Eigen::Index i = 0; i < points.rows(); ++i) path.dot(view.spot(points.row(i)));
  return std::string("<path fill=\"none\" stroke-linecap=\"round\" ") + style + " d=\"" + path.data() + "\"/>\n";
}

/// A panel a level: the control polygon in grey, the level over it.
std::string picture(const std::vector<Points>& levels, const ControlPolygon& polygon, bool interpolates,
                    const View& view) {
  const bool closed = polygon.curves[0].closed;
  const double width = static_cast<double>(levels.size()) * panel_width + 2 * border;
  const double height = panel_height + caption_height + border;
  std::string text = "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " + pixels(width) + " " + pixels(height) +
                     "\" width=\"" + pixels(width) + "\" height=\"" + pixels(height) +
                     "\" font-family=\"system-ui, sans-serif\" text-anchor=\"middle\">\n"
                     "<rect width=\"100%\" height=\"100%\" rx=\"16\" fill=\"#f4f2ed\"/>\n";
  const std::string color = interpolates ? "stroke=\"#9a6f45\"" : "stroke=\"#33658a\"";
  for (size_t k = 0; k < levels.size(); ++k) {
    text += "<g transform=\"translate(" + pixels(border + static_cast<double>(k) * panel_width) + " " + pixels(border) +
            ")\">\n<g transform=\"scale(.1)\" stroke-linejoin=\"round\">\n";
    text += stroke(polygon.points, closed, view, "stroke=\"#b9b4a8\" stroke-width=\"11\"");
    text += dots(polygon.points, view, "stroke=\"#b9b4a8\" stroke-width=\"52\"");
    text += stroke(levels[k], closed, view, (color + " stroke-width=\"18\"").c_str());
    text += dots(levels[k], view, (color + " stroke-width=\"" + (k < 2 ? "46" : k == 2 ? "38" : "30") + "\"").c_str());
    text += "</g>\n<text x=\"" + pixels(panel_width / 2) + "\" y=\"" + pixels(panel_height + 17) +
            "\" font-size=\"13\" font-weight=\"600\" fill=\"#2b2f38\">level " + std::to_string(k) +
            "</text>\n<text x=\"" + pixels(panel_width / 2) + "\" y=\"" + pixels(panel_height + 33) +
            "\" font-size=\"9.9\" fill=\"#6a6f7a\">" + std::to_string(levels[k].rows()) + " points</text>\n</g>\n";
  }
  return text + "</svg>\n";
}

}  // namespace

CurvePictures curve_pictures(int levels) {
  CurvePictures result;
  for (const NamedPolygon& named : polygons()) {
    const std::vector<Shown> all = shown(named.polygon, levels);
    View view;
    for (const Shown& one : all)
      for (const Points& level : one.levels) view.extend(level);
    PageSection section{.id = named.name, .title = named.title, .rows = {}};
    for (const Shown& one : all) {
      const std::string file = one.scheme + "-" + named.name + ".svg";
      result.files.push_back({file, picture(one.levels, named.polygon, one.interpolates, view)});
      section.rows.push_back({one.scheme, one.source, {{"limit", one.limit}, {"smoothness", one.smoothness}}, file});
    }
    result.sections.push_back(std::move(section));
  }
  return result;
}

}  // namespace sublimit::gallery
