// SPDX-License-Identifier: Apache-2.0
#pragma once
// What four-sided patches are as a surface: gaps and angles at their edges, area, volume.
#include "sublimit/cad/quad_edges.h"

namespace sublimit {

struct QuadMeasures {
  double largest_gap = 0;   ///< of edges and the sides that use them, at equal parameters
  double exact_angle = 0;   ///< between normals of exact quads at their common edges that are not sharp, radians
  double cap_angle = 0;     ///< the same where one of them is a cap
  double between_caps = 0;  ///< and where both are
  Eigen::Vector3d worst = Eigen::Vector3d::Zero();  ///< where the largest of these is
  double area = 0, volume = 0;                      ///< the volume means something if the surface is closed
  std::int64_t sharp_edges = 0, open_edges = 0;
};

/// Measures quads and edges; the gap of each edge and the volume of each quad are filled in.
QuadMeasures measure(std::vector<LimitQuad>& quads, QuadEdges& edges);

}  // namespace sublimit
