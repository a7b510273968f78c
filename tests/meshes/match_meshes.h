// SPDX-License-Identifier: Apache-2.0
#pragma once
// Matching two refined meshes with different numbering by connectivity. On connected manifolds one pair of
// corresponding half-edges determines all others, so that positions may differ and points may coincide.
#include <string>
#include <vector>

#include "peers/peer_mesh.h"
#include "sublimit/scheme/refine.h"

namespace sublimit::testing {

struct Matching {
  std::string mismatch;           ///< reason why connectivities differ; empty if they do not
  double error = 0;               ///< largest distance of matched points, relative to the bounding box
  Index worst = -1;               ///< vertex of ours with that distance
  std::vector<Index> vertex_map;  ///< their vertex for each of ours, one to one
  std::vector<double> distance;   ///< distance of each vertex, relative to the bounding box
};

/// Levels of a mesh by this library, and the points of the last one.
struct OurMesh {
  std::vector<Level> levels;
  Points positions;
  const Topology& topology() const { return levels.back().topology(); }
};
/// Refines a mesh by this library.
/// @param boundary  edge_only is the rule of other libraries, which have no corners
OurMesh our_mesh(const std::string& scheme, const Mesh& mesh, int levels, Boundary boundary = Boundary::edge_only);

/// Returns the matching with the smallest error among those that map our first half-edge to a nearby one of
/// theirs, with the same orientation.
/// @pre  both meshes are connected
Matching match(const OurMesh& ours, const PeerMesh& theirs);

}  // namespace sublimit::testing
