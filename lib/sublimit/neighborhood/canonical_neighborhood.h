// SPDX-License-Identifier: Apache-2.0
#pragma once
// The neighbourhood of a vertex as far as its limit depends on it: the faces around it and the sharpness of the vertex
// and of its edges, unfolded, in a canonical order. Equal signatures, equal limits: whatever is expensive is done once
// for each.
//
// Slots number the points: 0 the vertex, then, walking each fan counter-clockwise, the corners of its faces in order,
// each once (a fan's first edge, the rest of the face, the next edge ...). Points that coincide on a small mesh have
// slots of their own; only edges that really are one edge (non-manifold ones) share their end.
#include <vector>

#include "sublimit/mesh/sharpness.h"
#include "sublimit/mesh/topology.h"

namespace sublimit {

struct CanonicalNeighborhood {
  /// An edge at the vertex.
  struct Spoke {
    float sharpness = 0;
    /// Sharpness, one level on, of its half at the far end: under Chaikin creasing that depends on edges beyond.
    float far_child = 0;
    Index slot = 0;  ///< of its far end
  };
  /// A face at the vertex, between two spokes.
  struct Corner {
    Index face_size = 0;
    Index spoke = 0, next_spoke = 0;
    std::vector<Index> slots;  ///< of the whole face, from the vertex on
  };
  struct Fan {
    bool closed = false;
    std::vector<Corner> corners;  ///< counter-clockwise
  };

  float sharpness = 0;  ///< of the vertex
  Creasing creasing = Creasing::uniform;
  std::vector<Spoke> spokes;
  std::vector<Fan> fans;
  Index num_slots = 1;

  /// Everything above in words, sharpness by its float bits.
  std::vector<std::uint32_t> signature() const;
  Rule rule() const;
};

/// A neighbourhood and where it is on a mesh.
struct NeighborhoodAt {
  CanonicalNeighborhood type;
  std::vector<Index> vertices;                 ///< by slot
  std::vector<std::vector<HalfEdge>> corners;  ///< by fan
};

/// Neighbourhood of a vertex. A closed fan starts where its signature is least over all rotations (not reflections),
/// unless `aligned`: then it starts at `outgoing`, as its children do.
NeighborhoodAt neighborhood(const Topology& topology, const Sharpness& sharpness, Vertex v, bool aligned = false);

/// The neighbourhood as a mesh of its own: vertex i is slot i.
struct UnfoldedPatch {
  Topology topology;
  Sharpness sharpness;
};
UnfoldedPatch unfold(const CanonicalNeighborhood& type);
/// Edges of the unfolded patch, by spoke.
std::vector<Edge> spoke_edges(const CanonicalNeighborhood& type, const Topology& patch);

}  // namespace sublimit
