// SPDX-License-Identifier: Apache-2.0
#pragma once
// The neighbourhood of a vertex as far as its limit depends on it: the faces around it and the sharpness of the vertex
// and of its edges, unfolded, in a canonical order. Vertices with equal signatures have equal limits, so that
// expensive computations are done once per signature.
//
// Slots number the points: 0 the vertex, then, walking each fan counter-clockwise, the corners of its faces in order,
// each once (a fan's first edge, the rest of the face, the next edge ...). Points that coincide on a small mesh have
// slots of their own; only edges that really are one edge (non-manifold ones) share their end.
#include <vector>

#include "sublimit/mesh/sharpness.h"
#include "sublimit/mesh/topology.h"

namespace sublimit {

/// The one-ring of a vertex in canonical form.
struct CanonicalNeighborhood {
  /// An edge at the vertex.
  struct Spoke {
    float sharpness = 0;
    /// Sharpness on the next level of the half of the edge at its far end. Chaikin creasing makes it depend on
    /// edges outside the neighbourhood.
    float far_child = 0;
    Index slot = 0;  ///< slot of the far end
  };
  /// A face at the vertex, between two spokes.
  struct Corner {
    Index face_size = 0;
    Index spoke = 0, next_spoke = 0;
    std::vector<Index> slots;  ///< slots of the corners of the whole face, starting at the vertex
  };
  struct Fan {
    bool closed = false;
    std::vector<Corner> corners;  ///< counter-clockwise
  };

  float sharpness = 0;  ///< sharpness of the vertex
  Creasing creasing = Creasing::uniform;
  std::vector<Spoke> spokes;
  std::vector<Fan> fans;
  Index num_slots = 1;

  /// Returns all of the above as words; sharpness by the bits of its float.
  std::vector<std::uint32_t> signature() const;
  /// Returns the rule of the vertex.
  Rule rule() const;
};

/// A neighbourhood with its vertices and corners on a mesh.
struct NeighborhoodAt {
  CanonicalNeighborhood type;
  std::vector<Index> vertices;                 ///< by slot
  std::vector<std::vector<HalfEdge>> corners;  ///< by fan
};

/// Returns the neighbourhood of a vertex.
/// @param aligned  false: a closed fan starts where its signature is least over all rotations (not
///                 reflections). True: it starts at `topology.outgoing(v)`, which corresponds to that of the
///                 child vertex
NeighborhoodAt neighborhood(const Topology& topology, const Sharpness& sharpness, Vertex v, bool aligned = false);

/// The neighbourhood as a mesh of its own: vertex i is slot i.
struct UnfoldedPatch {
  Topology topology;
  Sharpness sharpness;
};
/// Returns the neighbourhood as a mesh.
UnfoldedPatch unfold(const CanonicalNeighborhood& type);
/// Returns the edge of the unfolded patch for each spoke.
std::vector<Edge> spoke_edges(const CanonicalNeighborhood& type, const Topology& patch);

}  // namespace sublimit
