// SPDX-License-Identifier: Apache-2.0
#pragma once
// Control polygons: points of any dimension and the curves that run through them.
//
//   ControlPolygon polygon = polygon_through(Points{{0, 0}, {1, 2}, {3, 2}, {4, 0}});
//   polygon.curves[0].closed = true;
//   const std::vector<CurveLevel> levels = refine(curve_scheme("chaikin"), polygon, 3);  // curves/curve_refine.h
#include <cstdint>
#include <string>
#include <vector>

#include "sublimit/core/types.h"

namespace sublimit {

/// A control polygon, as a file or a caller gives it. Plain data.
struct [[nodiscard]] ControlPolygon {
  /// A curve through some of the points, in order. A closed one does not repeat the first.
  struct Curve {
    std::vector<Index> points;
    bool closed = false;
  };

  Points points;    ///< #P x dimension
  Points tangents;  ///< #P x dimension for schemes that take tangents or derivatives, else empty
  std::vector<Curve> curves;

  std::vector<std::string> columns;   ///< names of the coordinates, then of the tangents; empty if the file has none
  std::string file;                   ///< file that the points were read from; empty if none, or one without lines
  std::vector<std::int64_t> lines;    ///< line of each point in that file
  std::vector<std::string> warnings;  ///< reservations of the reader, each with file:line

  Index num_points() const { return static_cast<Index>(points.rows()); }
  int dimension() const { return static_cast<int>(points.cols()); }
  bool has_tangents() const { return tangents.rows() > 0; }
};

/// Returns a polygon of one curve through all points, in order.
/// @param points  #P x dimension
inline ControlPolygon polygon_through(const Points& points, bool closed = false) {
  ControlPolygon polygon;
  polygon.points = points;
  polygon.curves.push_back({{}, closed});
  for (Index i = 0; i < polygon.num_points(); ++i) polygon.curves[0].points.push_back(i);
  return polygon;
}

}  // namespace sublimit
