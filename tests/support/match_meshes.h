// SPDX-License-Identifier: Apache-2.0
#pragma once
// Two refined meshes that number their elements differently, matched through connectivity: on connected manifolds one
// pair of corresponding half-edges decides about all others, so positions may differ and points may coincide.
#include <string>
#include <vector>

#include "sublimit/scheme/refine.h"
#include "support/peer_mesh.h"

namespace sublimit::testing {

struct Matching {
  std::string mismatch;           ///< why connectivities cannot be the same; empty if they are
  double error = 0;               ///< largest distance of corresponding points, over the bounding box
  Index worst = -1;               ///< where, in our numbers
  std::vector<Index> vertex_map;  ///< their vertex of each of ours, one to one
  std::vector<double> distance;   ///< of each vertex, over the bounding box
};

/// Our levels of a mesh, and the points of the last one.
struct OurMesh {
  std::vector<Level> levels;
  Points positions;
  const Topology& topology() const { return levels.back().topology(); }
};
/// @param boundary  other libraries know no corners: edge_only is what they do
OurMesh our_mesh(const std::string& scheme, const Mesh& mesh, int levels, Boundary boundary = Boundary::edge_only);

/// The closest of the ways to lay the half-edges near our first one onto it. Orientation counts.
/// @pre  both meshes are connected
Matching match(const OurMesh& ours, const PeerMesh& theirs);

}  // namespace sublimit::testing
