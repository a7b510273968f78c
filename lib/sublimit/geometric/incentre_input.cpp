// SPDX-License-Identifier: Apache-2.0
#include "sublimit/geometric/incentre_input.h"

#include <cmath>
#include <limits>
#include <string>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/error.h"
#include "sublimit/geometric/hermite_polygon.h"

namespace sublimit {
namespace {

constexpr double unit_tolerance = 1e-6;  // of lengths of given tangents

std::string place(const ControlPolygon& polygon, Index i) {
  if (polygon.lines.empty()) return (polygon.file.empty() ? "" : polygon.file + ": ");
  return polygon.file + ":" + format_number(polygon.lines[i]) + ": ";
}

constexpr const char* layout = "x,y,tx,ty or x,y,z,tx,ty,tz";

void check_point(const ControlPolygon& polygon, Index i) {
  if (!polygon.points.row(i).allFinite() || !polygon.tangents.row(i).allFinite())
    throw InvalidMesh(place(polygon, i) + "point " + format_number(i) +
                      " or its tangent is not finite; hermite-incentre needs numbers");
  const double length = polygon.tangents.row(i).stableNorm();
  if (std::abs(length - 1) > unit_tolerance)
    throw InvalidMesh(place(polygon, i) + "the tangent of point " + format_number(i) + " has length " +
                      format_number(length) + "; hermite-incentre takes " + layout + " with tangents of length 1");
}

void check_curve(const ControlPolygon& polygon, size_t c) {
  const ControlPolygon::Curve& curve = polygon.curves[c];
  for (const Index i : curve.points)
    if (i < 0 || i >= polygon.num_points())
      throw InvalidMesh("a curve has point " + format_number(i) + "; there are points 0 to " +
                        format_number(polygon.num_points() - 1));
  if (curve.points.size() < 2)
    throw UnsupportedTopology((curve.points.empty() ? std::string() : place(polygon, curve.points[0])) + "curve " +
                              format_number(c) + " has " + (curve.points.empty() ? "no points" : "1 point") +
                              "; hermite-incentre needs at least 2");
  for (Index i = 0; i < num_segments(curve); ++i) {
    const Index a = curve.points[i], b = curve.points[(i + 1) % curve.points.size()];
    const double segment = (polygon.points.row(b) - polygon.points.row(a)).stableNorm();
    if (segment == 0)
      throw InvalidMesh(
          place(polygon, b) + "points " + format_number(a) + " and " + format_number(b) +
          " are next to each other and equal; a segment needs a length: leave one of them out" +
          (curve.closed && i + 1 == num_segments(curve) ? " (a closed curve does not repeat its first)" : ""));
    if (!std::isfinite(segment))
      throw InvalidMesh(place(polygon, b) + "points " + format_number(a) + " and " + format_number(b) +
                        " are too far apart; scale the curve down");
  }
}

}  // namespace

ControlPolygon checked_for_incentres(ControlPolygon polygon) {
  if (polygon.curves.empty()) throw InvalidMesh("there are no curves; hermite-incentre needs a polygon");
  if (!polygon.has_tangents())
    throw InvalidMesh((polygon.file.empty() ? "" : polygon.file + ": ") +
                      "points without tangents; hermite-incentre takes " + layout);
  if (polygon.dimension() < 2 || polygon.dimension() > 3 || polygon.tangents.cols() != polygon.points.cols() ||
      polygon.tangents.rows() != polygon.points.rows())
    throw UnsupportedTopology((polygon.file.empty() ? "" : polygon.file + ": ") + "points of " +
                              format_number(polygon.dimension()) + " and tangents of " +
                              format_number(polygon.tangents.cols()) + " coordinates; hermite-incentre takes " +
                              layout);
  for (Index i = 0; i < polygon.num_points(); ++i) {
    check_point(polygon, i);
    // Tangents that are units already keep their bits, so that refining twice by 1 is refining once by 2.
    const double length = polygon.tangents.row(i).norm();
    if (std::abs(length - 1) > 4 * std::numeric_limits<double>::epsilon()) polygon.tangents.row(i) /= length;
  }
  for (size_t c = 0; c < polygon.curves.size(); ++c) check_curve(polygon, c);
  return polygon;
}

}  // namespace sublimit
