// SPDX-License-Identifier: Apache-2.0
#include "sublimit/tessellation/detail/cell_polygon.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>

namespace sublimit {
namespace {

std::int64_t twice_area(const CellCorner& a, const CellCorner& b, const CellCorner& c) {
  return std::int64_t(b.i - a.i) * (c.j - a.j) - std::int64_t(b.j - a.j) * (c.i - a.i);
}

/// How round a triangle is: 1 if its sides are equal, 0 if it has no area.
double roundness(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
  const double sides = (b - a).squaredNorm() + (c - b).squaredNorm() + (a - c).squaredNorm();
  return sides > 0 ? 2 * std::sqrt(3.0) * (b - a).cross(c - a).norm() / sides : 0;
}

}  // namespace

void add_triangle(Index address, const PolygonCorner& a, const PolygonCorner& b, const PolygonCorner& c,
                  Tessellation& made) {
  Tessellation::Triangle triangle{address, {a.vertex, b.vertex, c.vertex}, {}};
  size_t k = 0;
  for (const PolygonCorner* corner : {&a, &b, &c}) triangle.uv[k++] = corner->at.uv();
  made.triangles.push_back(triangle);
}

void triangulate(Index address, std::vector<PolygonCorner>& polygon, Tessellation& made) {
  const auto at = [&](size_t k) { return Eigen::Vector3d(made.points.row(polygon[k].vertex)); };
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
    add_triangle(address, polygon[before], polygon[best], polygon[after], made);
    polygon.erase(polygon.begin() + std::ptrdiff_t(best));
  }
  add_triangle(address, polygon[0], polygon[1], polygon[2], made);
}

}  // namespace sublimit
