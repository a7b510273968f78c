// SPDX-License-Identifier: Apache-2.0
#pragma once
// Points of the plane, and their positions on a drawing.
#include <Eigen/Core>

#include <string>
#include <utility>
#include <vector>

#include "sublimit/report/page/json.h"

namespace sublimit::page {

using Point = Eigen::Vector2d;

/// Returns the grid of a regular part: "line", "square", or "triangular" if the third direction of edges is (1,
/// 1) and "triangular-" if it is (1, -1), according to the mask.
std::string grid_of(const Json& regular);

/// Returns the position of a grid point; triangles are equilateral.
Point on_grid(const std::string& grid, double u, double v);

/// Returns the position of a label [sector, x, y] of a neighbourhood, on spokes at angles of `turn` radians.
Point at_label(const Json& label, double turn);

/// A map from points to pixels: as large as fits, y upwards, and no higher than needed.
struct Fit {
  double scale = 1, width = 0, height = 0;
  Point middle = Point::Zero();
  double x(const Point& p) const { return width / 2 + scale * (p.x() - middle.x()); }
  double y(const Point& p) const { return height / 2 - scale * (p.y() - middle.y()); }
  std::vector<std::pair<double, double>> all(const std::vector<Point>& points) const;
};
Fit fit_points(const std::vector<Point>& points, double width, double most_height, double margin);

/// Returns true if a point is inside a polygon.
bool inside(const std::vector<Point>& polygon, const Point& p);

}  // namespace sublimit::page
