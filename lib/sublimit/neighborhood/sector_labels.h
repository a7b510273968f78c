// SPDX-License-Identifier: Apache-2.0
#pragma once
// Where the points around a centre lie: in sector s, x steps along spoke s and y steps along spoke s + 1. Around a
// vertex x >= 1, y >= 0; around a face its corners are (s; 1/2, 1/2) and x, y >= 1/2; the vertex itself is (0; 0, 0).
// The points of the last spoke of an open fan of m sectors are (m; x, 0). In these labels a scheme's regular part is
// one mask, and a child lies at twice (three times) the mean of its parents.
#include <compare>
#include <map>

#include "sublimit/mesh/sharpness.h"
#include "sublimit/neighborhood/centre.h"

namespace sublimit {

struct SectorLabel {
  int sector = 0;
  int x2 = 0, y2 = 0;  ///< twice x and y
  double x() const { return x2 / 2.0; }
  double y() const { return y2 / 2.0; }
  auto operator<=>(const SectorLabel&) const = default;
};

/// Labels of vertices around a centre, as far as all faces are regular: quadrilaterals or triangles around vertices of
/// valence 4 or 6 (which nobody checks: beyond another extraordinary point labels mean nothing).
/// @param reach  greatest x and y (x + y of triangles) of a label
/// @return  by vertex; of the middle of a border edge: sector 0, x along the border, y into the surface
std::map<Index, SectorLabel> sector_labels(const Topology& topology, const Centre& centre, int reach);

}  // namespace sublimit
