// SPDX-License-Identifier: Apache-2.0
#pragma once
// Measures of a surface of four-sided patches: gaps and angles at edges, area, volume.
#include "sublimit/cad/quad_edges.h"

namespace sublimit {

/// The measures.
struct QuadMeasures {
  double largest_gap = 0;   ///< largest distance between edges and their sides, at equal parameters
  double exact_angle = 0;   ///< largest angle between normals of exact quads at common smooth edges, radians
  double cap_angle = 0;     ///< likewise between an exact quad and a cap
  double between_caps = 0;  ///< likewise between two caps
  Eigen::Vector3d worst = Eigen::Vector3d::Zero();  ///< place of the largest of these angles
  double area = 0, volume = 0;                      ///< the volume is meaningful for closed surfaces
  std::int64_t sharp_edges = 0, open_edges = 0;
};

/// Returns the measures, and sets the gap of each edge and the volume of each quad.
QuadMeasures measure(std::vector<LimitQuad>& quads, QuadEdges& edges);

}  // namespace sublimit
