// SPDX-License-Identifier: Apache-2.0
#pragma once
// Access to polygons of points with tangents by segment.
#include <cstdint>
#include <limits>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/error.h"
#include "sublimit/geometric/circular_arc.h"
#include "sublimit/mesh/control_polygon.h"

namespace sublimit {

/// Returns point i with its tangent; z = 0 for polygons in the plane.
HermitePoint hermite_point(const ControlPolygon& polygon, Index i);
void set_hermite_point(ControlPolygon& polygon, Index i, const HermitePoint& p);

/// Returns the number of segments of a curve.
Index num_segments(const ControlPolygon::Curve& curve);

/// Calls `body` with the ends of each segment of a curve.
template <class Body>
void for_each_segment(const ControlPolygon& polygon, const ControlPolygon::Curve& curve, const Body& body) {
  for (Index i = 0; i < num_segments(curve); ++i)
    body(hermite_point(polygon, curve.points[i]), hermite_point(polygon, curve.points[(i + 1) % curve.points.size()]));
}

/// Returns a polygon with `pieces` points for each segment of `parent`.
/// @param at  at(curve, segment, j) returns point j of a segment; j = 0 is its first point
/// @throws ResourceError  more points than 32-bit indices count
template <class At>
ControlPolygon with_points_on_segments(const ControlPolygon& parent, Index pieces, const At& at) {
  std::int64_t count = 0;
  for (const ControlPolygon::Curve& curve : parent.curves)
    count += std::int64_t{num_segments(curve)} * pieces + (curve.closed ? 0 : 1);
  if (count > std::numeric_limits<Index>::max())
    throw ResourceError(format_number(count) + " points are more than 32-bit indices count; use fewer levels");
  ControlPolygon child;
  child.columns = parent.columns;
  child.points.resize(count, parent.dimension());
  child.tangents.resize(count, parent.dimension());
  Index row = 0;
  for (size_t c = 0; c < parent.curves.size(); ++c) {
    const ControlPolygon::Curve& curve = parent.curves[c];
    ControlPolygon::Curve& refined = child.curves.emplace_back();
    refined.closed = curve.closed;
    const auto add = [&](const HermitePoint& p) {
      set_hermite_point(child, row, p);
      refined.points.push_back(row++);
    };
    for (Index i = 0; i < num_segments(curve); ++i)
      for (Index j = 0; j < pieces; ++j) add(at(c, i, j));
    if (!curve.closed) add(hermite_point(parent, curve.points.back()));
  }
  return child;
}

}  // namespace sublimit
