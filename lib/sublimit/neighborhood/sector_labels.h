// SPDX-License-Identifier: Apache-2.0
#pragma once
// Coordinates of the points around a centre: (s; x, y) is in sector s, x steps along spoke s and y steps along
// spoke s + 1. Around a vertex x >= 1, y >= 0, and the vertex itself is (0; 0, 0). Around a face x, y >= 1/2,
// and its corners are (s; 1/2, 1/2). The points of the last spoke of an open fan of m sectors are (m; x, 0). In
// these labels a scheme has one mask in regular regions, and a child lies at twice (sqrt3 schemes, per period:
// three times) the mean of its parents.
#include <compare>
#include <map>

#include "sublimit/mesh/sharpness.h"
#include "sublimit/neighborhood/centre.h"

namespace sublimit {

/// Label of a point around a centre.
struct SectorLabel {
  int sector = 0;
  int x2 = 0, y2 = 0;  ///< twice x and y
  double x() const { return x2 / 2.0; }
  double y() const { return y2 / 2.0; }
  auto operator<=>(const SectorLabel&) const = default;
};

/// Returns labels of the vertices around a centre. The faces must be regular: quadrilaterals or triangles with
/// vertices of valence 4 or 6. This is not checked; labels beyond another extraordinary point are meaningless.
/// @param reach  largest x and y (for triangles: x + y) of a label
/// @return  labels by vertex; around the middle of a border edge: sector 0, x along the border, y into the
///          surface
std::map<Index, SectorLabel> sector_labels(const Topology& topology, const Centre& centre, int reach);

}  // namespace sublimit
