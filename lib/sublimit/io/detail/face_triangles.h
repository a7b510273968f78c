// SPDX-License-Identifier: Apache-2.0
#pragma once
// Triangles of a polygon, for formats that have nothing else.
#include <array>
#include <span>
#include <vector>

#include "sublimit/core/types.h"

namespace sublimit {

/// Cuts polygons into triangles that do not leave them, seen along their mean normal.
class FaceTriangles {
 public:
  /// A corner of the polygon, counted from 0.
  using Corners = std::array<Index, 3>;

  /// Cuts a polygon. A fan is taken around the first corner that has all of the polygon on the right side, and else
  /// ears are cut off. Polygons that cross themselves, and those of more than 4096 corners, are a fan around corner 0
  /// if neither works.
  /// @param points    points of the mesh
  /// @param vertices  of the polygon, at least 3
  /// @param avoided   a vertex around which no fan should be, if another one does; -1: none
  /// @return  valid until the next call; those of a fan begin with its corner, in order
  std::span<const Corners> cut(const Points& points, std::span<const Index> vertices, Index avoided = -1);
  /// Returns true if the last polygon is a fan around a corner.
  bool is_fan() const { return is_fan_; }

 private:
  double twice_area(Index a, Index b, Index c) const;
  bool fan(Index around);
  bool ears();
  bool holds_another(Index a, Index b, Index c) const;

  std::vector<std::array<double, 2>> flat_;  // the polygon in a plane
  std::vector<Index> left_;                  // corners that no ear has taken
  std::vector<Corners> triangles_;
  bool is_fan_ = true;
};

}  // namespace sublimit
