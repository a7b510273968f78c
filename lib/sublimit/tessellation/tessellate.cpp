// SPDX-License-Identifier: Apache-2.0
#include "sublimit/tessellation/tessellate.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "sublimit/base/error.h"
#include "sublimit/limit/limit_patches.h"
#include "sublimit/tessellation/cell_vertices.h"
#include "sublimit/tessellation/flat_cells.h"

namespace sublimit {
namespace {

struct PolygonCorner {
  Index vertex;
  CellCorner at;
};

/// Appends the points between two corners of a side, in order: halves, halves of these, and so on. A point inside of a
/// half is only there where the middle is.
void add_between(const CellVertices& vertices, Index address, const CellCorner& a, const CellCorner& b,
                 std::vector<PolygonCorner>& polygon) {
  if ((a.i + b.i) % 2 != 0 || (a.j + b.j) % 2 != 0) return;
  const CellCorner middle{(a.i + b.i) / 2, (a.j + b.j) / 2};
  const Index vertex = vertices.find(address, middle);
  if (vertex < 0) return;
  add_between(vertices, address, a, middle, polygon);
  polygon.push_back({vertex, middle});
  add_between(vertices, address, middle, b, polygon);
}

std::int64_t twice_area(const CellCorner& a, const CellCorner& b, const CellCorner& c) {
  return std::int64_t(b.i - a.i) * (c.j - a.j) - std::int64_t(b.j - a.j) * (c.i - a.i);
}

/// How round a triangle is: 1 if its sides are equal, 0 if it has no area.
double roundness(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
  const double sides = (b - a).squaredNorm() + (c - b).squaredNorm() + (a - c).squaredNorm();
  return sides > 0 ? 2 * std::sqrt(3.0) * (b - a).cross(c - a).norm() / sides : 0;
}

/// Cuts off the roundest corner that has an area in parameters, until a triangle is left. A convex polygon, corners in
/// the middle of sides included, always has one.
template <class Add>
void triangulate(std::vector<PolygonCorner>& polygon, const Points& points, const Add& add) {
  const auto at = [&](size_t k) { return Eigen::Vector3d(points.row(polygon[k].vertex)); };
  while (polygon.size() > 3) {
    const size_t n = polygon.size();
    std::int64_t area = 0;
    for (size_t m = 1; m + 1 < n; ++m) area += twice_area(polygon[0].at, polygon[m].at, polygon[m + 1].at);
    size_t best = n;
    double most = -1;
    for (size_t k = 0; k < n; ++k) {
      const size_t before = (k + n - 1) % n, after = (k + 1) % n;
      const std::int64_t cut = twice_area(polygon[before].at, polygon[k].at, polygon[after].at);
      if (cut <= 0 || cut >= area) continue;  // neither it nor what is left may be a line
      const double own = roundness(at(before), at(k), at(after));
      const double quality = n == 4 ? std::min(own, roundness(at(after), at((after + 1) % n), at(before))) : own;
      if (quality > most) most = quality, best = k;
    }
    const size_t before = (best + n - 1) % n, after = (best + 1) % n;
    add(polygon[before], polygon[best], polygon[after]);
    polygon.erase(polygon.begin() + std::ptrdiff_t(best));
  }
  add(polygon[0], polygon[1], polygon[2]);
}

void check(const TessellationOptions& options) {
  if (!(options.chord > 0) || !std::isfinite(options.chord))
    throw InvalidParameter("the chord is " + std::to_string(options.chord) + "; a distance above 0 is right");
  if (!(options.angle >= 0) || !std::isfinite(options.angle))
    throw InvalidParameter("the angle is " + std::to_string(options.angle) + "; 0 or more is right");
  if (options.max_triangles < 1)
    throw InvalidParameter("at most " + std::to_string(options.max_triangles) + " triangles; 1 or more is right");
}

}  // namespace

Tessellation tessellate(const LimitSurface& surface, const Points& control, const TessellationOptions& options) {
  check(options);
  const LimitSurface::Parts& parts = LimitPatches::parts_of(surface);
  const size_t corners = parts.addresses.triangles() ? 3 : 4;
  const std::vector<FlatCell> cells =
      flat_cells(surface, control, {options.chord, options.angle, options.max_triangles});
  Tessellation made;
  made.cells = std::ssize(cells);
  CellVertices vertices(parts);
  for (const FlatCell& cell : cells) {
    made.bound = std::max(made.bound, cell.bound);
    for (size_t k = 0; k < corners; ++k) vertices.add(cell.address, cell.corners[k]);
  }
  made.places = vertices.places();
  made.points = surface.evaluate(control, made.places).position;

  std::vector<PolygonCorner> polygon;
  for (const FlatCell& cell : cells) {
    polygon.clear();
    for (size_t k = 0; k < corners; ++k) {
      const CellCorner &a = cell.corners[k], &b = cell.corners[(k + 1) % corners];
      polygon.push_back({vertices.find(cell.address, a), a});
      add_between(vertices, cell.address, a, b, polygon);
    }
    triangulate(polygon, made.points, [&](const PolygonCorner& a, const PolygonCorner& b, const PolygonCorner& c) {
      Tessellation::Triangle triangle{cell.address, {a.vertex, b.vertex, c.vertex}, {}};
      size_t k = 0;
      for (const PolygonCorner* corner : {&a, &b, &c})
        triangle.uv[k++] = {double(corner->at.i) / cell_steps, double(corner->at.j) / cell_steps};
      made.triangles.push_back(triangle);
    });
    if (std::ssize(made.triangles) > options.max_triangles)
      throw ResourceError("more than " + std::to_string(options.max_triangles) +
                          " triangles are needed; allow a larger distance or more triangles");
  }
  return made;
}

}  // namespace sublimit
