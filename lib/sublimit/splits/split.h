// SPDX-License-Identifier: Apache-2.0
#pragma once
// Splits: the topology of one refinement step. No weights here, and no geometry.
#include <utility>
#include <vector>

#include "sublimit/mesh/topology.h"
#include "sublimit/types.h"

namespace sublimit {

enum class Split {
  pqq,  ///< primal quadrilateral: an n-gon becomes n quads around a face point
  ptq,  ///< primal triangular: a triangle becomes four
};

/// One level of refinement: the child's connectivity and where every child element comes from.
struct Refinement {
  enum class Origin { vertex, face, edge };

  Topology topology;  ///< of the child

  /// Child vertices in this order: one per parent vertex, then one per parent face, then one per parent edge, each group
  /// in the parents' order. A group that the split does not make is empty.
  Index from_vertices = 0, from_faces = 0, from_edges = 0;

  UninitializedVector<Index> face_parent;  ///< parent face of every child face
  /// Per child edge: 2 e for the half of parent edge e at its tail, 2 e + 1 for the half at its head, -1 inside a face.
  UninitializedVector<Index> edge_parent;

  Vertex child(Vertex v) const { return Vertex{index(v)}; }
  Vertex child(Face f) const { return Vertex{from_vertices + index(f)}; }
  Vertex child(Edge e) const { return Vertex{from_vertices + from_faces + index(e)}; }
  Origin origin(Vertex child) const {
    const Index i = index(child) - from_vertices;
    return i < 0 ? Origin::vertex : i < from_faces ? Origin::face : Origin::edge;
  }
  /// Parent vertex, face or edge (see `origin`) of a child vertex.
  Index parent(Vertex child) const {
    const Index i = index(child);
    return i < from_vertices ? i : i - from_vertices < from_faces ? i - from_vertices : i - from_vertices - from_faces;
  }
  /// The two child half-edges that a parent half-edge becomes: from its vertex to the midpoint, and on to its head.
  std::pair<HalfEdge, HalfEdge> halves(const Topology& parent, HalfEdge h) const;

  Split split = Split::pqq;
};

/// One level of `split` applied to a mesh.
///
/// Children of a face stand together, in the parents' order; a child keeps the orientation of its parent's corners: child i
/// of a quad or triangle has the child of corner i at position i, child i of any other face has it at position 0, and the
/// middle triangle has the midpoint opposite to corner i at position i.
/// @throws UnsupportedTopology  ptq on a face that is not a triangle
/// @throws ResourceError        more half-edges than 32-bit indices; checked before memory is taken
Refinement refine(const Topology& parent, Split split);

/// Corners of the child mesh: what `refine` would need, without doing it.
std::int64_t num_child_half_edges(const Topology& parent, Split split);

}  // namespace sublimit
