// SPDX-License-Identifier: Apache-2.0
#pragma once
// Control polygons as a file or a caller gives them: points of any dimension and the curves that run through them.
// Plain data.
#include <cstdint>
#include <string>
#include <vector>

#include "sublimit/core/types.h"

namespace sublimit {

struct [[nodiscard]] ControlPolygon {
  /// One curve: its points in order. A closed one does not repeat the first.
  struct Curve {
    std::vector<Index> points;
    bool closed = false;
  };

  Points points;    ///< #P x dimension
  Points tangents;  ///< #P x dimension for schemes that take tangents or derivatives, else empty
  std::vector<Curve> curves;

  std::vector<std::string> columns;   ///< names of the coordinates, then of the tangents; empty if the file has none
  std::string file;                   ///< where the points come from; empty if from no file, or one without lines
  std::vector<std::int64_t> lines;    ///< of the points in that file
  std::vector<std::string> warnings;  ///< what the reader accepted but wants known, each with file:line

  Index num_points() const { return static_cast<Index>(points.rows()); }
  int dimension() const { return static_cast<int>(points.cols()); }
  bool has_tangents() const { return tangents.rows() > 0; }
};

/// A polygon through all of `points`, in order.
inline ControlPolygon polygon_through(const Points& points, bool closed = false) {
  ControlPolygon polygon;
  polygon.points = points;
  polygon.curves.push_back({{}, closed});
  for (Index i = 0; i < polygon.num_points(); ++i) polygon.curves[0].points.push_back(i);
  return polygon;
}

}  // namespace sublimit
