// SPDX-License-Identifier: Apache-2.0
#pragma once
// Connectivity of a polygon mesh as immutable half-edge arrays.
//
//   const Topology topology(view(mesh));
//   for (const Topology::Fault& fault : topology.faults()) std::cerr << fault.message << "\n";
//   for (const Edge e : topology.edges(Vertex{0}))
//     if (topology.is_boundary(e)) std::cout << index(topology.head(e)) << "\n";
//
// A half-edge is a corner of a face: it starts at the corner's vertex and runs counter-clockwise to the next one; the
// half-edges of a face are contiguous. Half-edges have twins only where the mesh is a manifold: two faces, consistently
// wound. A non-manifold edge is one edge without twins, so walks around a vertex stay on one sheet (a fan), while
// vertices and edges keep their identity: what the sheets share is welded by being the same element.
#include <span>
#include <string>
#include <vector>

#include "sublimit/core/types.h"
#include "sublimit/core/uninitialized.h"
#include "sublimit/mesh/mesh_view.h"

namespace sublimit {

class TopologyBuilder;

/// Connectivity of a mesh. It never changes: threads may share it. Queries of an element take constant time unless they
/// return a vector; those of numbers that do not exist are undefined.
class Topology {
 public:
  /// A violation of the conditions of a manifold. Such meshes are accepted, and each violation is listed.
  struct Fault {
    enum class Kind {
      isolated_vertex,
      repeated_vertex,       ///< a face visits a vertex twice
      degenerate_edge,       ///< a face visits a vertex twice in a row
      repeated_edge,         ///< a face uses an edge twice
      crowded_edge,          ///< an edge has more than two faces
      inconsistent_winding,  ///< two faces use an edge in the same direction
      several_fans,          ///< faces around a vertex are not one fan
    };
    Kind kind;
    std::string message;  ///< the violation and its place: "edge (4,9) is used by 3 faces: 1, 7, 12"
  };

  /// Makes the connectivity of an empty mesh.
  Topology() = default;

  /// Makes the connectivity of the faces of `mesh`.
  ///
  /// Edges are numbered by first appearance, walking the faces in order, corner by corner.
  /// @throws InvalidMesh    a face with fewer than 3 corners, a vertex out of range, arrays that do not fit together
  /// @throws ResourceError  more half-edges than 32-bit indices
  /// @note  Faces that repeat a vertex, isolated vertices, non-manifold edges and vertices and inconsistent winding are
  ///        accepted; `faults()` lists every one of them.
  explicit Topology(const MeshView& mesh);

  Index num_vertices() const { return static_cast<Index>(vertex_out_.size()); }
  Index num_edges() const { return static_cast<Index>(edge_half_.size()); }
  Index num_faces() const { return num_faces_; }
  Index num_half_edges() const { return static_cast<Index>(tail_.size()); }
  /// Returns all violations of the conditions of a manifold.
  const std::vector<Fault>& faults() const { return faults_; }

  /// True if every edge and vertex is manifold.
  bool is_manifold() const { return nonmanifold_vertices_.empty() && nonmanifold_edges_.empty(); }

  // Faces.
  /// Returns the number of corners of a face.
  Index size(Face f) const { return uniform_ ? uniform_ : offsets_[index(f) + 1] - offsets_[index(f)]; }
  HalfEdge first(Face f) const { return HalfEdge{uniform_ ? uniform_ * index(f) : offsets_[index(f)]}; }
  /// Returns the half-edge that starts at corner i.
  HalfEdge corner(Face f, Index i) const { return HalfEdge{index(first(f)) + i}; }
  std::span<const Index> vertices(Face f) const { return {tail_.data() + index(first(f)), size_t(size(f))}; }
  /// Returns the size of all faces if it is the same, else 0.
  Index uniform_face_size() const { return uniform_; }

  // Half-edges.
  /// Returns the face that a half-edge belongs to.
  Face face(HalfEdge h) const {  // divisions by constants: by a variable they would be what refinement waits for
    if (uniform_ == 4) return Face{index(h) >> 2};
    if (uniform_ == 3) return Face{index(h) / 3};
    return Face{uniform_ ? index(h) / uniform_ : face_[index(h)]};
  }
  /// Returns the position of a half-edge within its face.
  Index corner_index(HalfEdge h) const { return index(h) - index(first(face(h))); }
  /// Returns the next half-edge of the face, counter-clockwise.
  HalfEdge next(HalfEdge h) const {
    if (uniform_ == 4) return HalfEdge{(index(h) & ~3) | ((index(h) + 1) & 3)};
    const Face f = face(h);
    return index(h) + 1 < index(first(f)) + size(f) ? HalfEdge{index(h) + 1} : first(f);
  }
  /// Returns the half-edge of the face before this one.
  HalfEdge prev(HalfEdge h) const {
    if (uniform_ == 4) return HalfEdge{(index(h) & ~3) | ((index(h) + 3) & 3)};
    const Face f = face(h);
    return h == first(f) ? HalfEdge{index(h) + size(f) - 1} : HalfEdge{index(h) - 1};
  }
  /// Returns the opposite half-edge in the other face of a manifold edge; none (-1) on boundary and non-manifold edges.
  HalfEdge twin(HalfEdge h) const { return HalfEdge{twin_[index(h)]}; }
  Edge edge(HalfEdge h) const { return Edge{edge_[index(h)]}; }
  Vertex tail(HalfEdge h) const { return Vertex{tail_[index(h)]}; }
  Vertex head(HalfEdge h) const { return tail(next(h)); }
  /// True if a half-edge runs in the direction of its edge, from the edge's tail to its head; always for a loop (v,v).
  bool forward(HalfEdge h) const { return tail(h) == tail(edge(h)); }

  // Edges. Their direction is that of their first half-edge.
  HalfEdge half_edge(Edge e) const { return HalfEdge{edge_half_[index(e)]}; }
  Vertex tail(Edge e) const { return tail(half_edge(e)); }
  Vertex head(Edge e) const { return head(half_edge(e)); }
  /// True if the edge has a single half-edge.
  bool is_boundary(Edge e) const;
  bool is_nonmanifold(Edge e) const;
  /// Returns all half-edges of an edge, ascending.
  std::vector<HalfEdge> half_edges(Edge e) const;

  // Vertices.
  /// True if no face uses the vertex.
  bool is_isolated(Vertex v) const { return vertex_out_[index(v)] == isolated; }
  /// True if the faces around the vertex are not a single fan, or one of its edges is non-manifold.
  bool is_nonmanifold(Vertex v) const { return vertex_out_[index(v)] <= first_nonmanifold; }
  bool is_boundary(Vertex v) const;
  /// Returns the number of corners at the vertex: of incident faces, for a manifold vertex.
  Index num_faces(Vertex v) const { return degree_[index(v)]; }
  /// Returns the first half-edge from a manifold vertex in counter-clockwise order: on the boundary the one without a
  /// twin, so that `ccw` visits all. Returns none (-1) for isolated and non-manifold vertices.
  HalfEdge outgoing(Vertex v) const { return HalfEdge{std::max<Index>(vertex_out_[index(v)], -1)}; }
  /// Returns the first half-edge of each fan at the vertex: one for a manifold vertex, none for an isolated one.
  std::vector<HalfEdge> fans(Vertex v) const;
  /// Returns the next half-edge with the same tail, counter-clockwise, on the same sheet; none (-1) at a boundary.
  HalfEdge ccw(HalfEdge h) const { return twin(prev(h)); }
  /// Returns the edges at the vertex: counter-clockwise for a manifold vertex, else ascending, loops (v,v) twice.
  std::vector<Edge> edges(Vertex v) const;

 private:
  friend class TopologyBuilder;
  static constexpr Index isolated = -1;
  static constexpr Index first_nonmanifold = -2;
  struct NonManifoldVertex {
    std::vector<Index> fans, edges;
  };
  struct NonManifoldEdge {
    Index edge;
    std::vector<Index> halves;
  };
  const NonManifoldEdge* find_nonmanifold(Edge e) const;

  Index num_faces_ = 0;
  Index uniform_ = 0;           // face size, or 0 for mixed sizes
  std::vector<Index> offsets_;  // mixed sizes: first half-edge of each face, and the end
  std::vector<Index> face_;     // mixed sizes: face of each half-edge
  UninitializedVector<Index> tail_, twin_, edge_;
  UninitializedVector<Index> edge_half_;  // first half-edge of each edge
  UninitializedVector<Index>
      vertex_out_;  // half-edge, `isolated`, or first_nonmanifold - position in nonmanifold_vertices_
  UninitializedVector<Index> degree_;
  std::vector<NonManifoldVertex> nonmanifold_vertices_;
  std::vector<NonManifoldEdge> nonmanifold_edges_;  // ascending
  std::vector<Fault> faults_;
};

/// Turns faces so that neighbours run through their edge in opposite directions, as few in each connected part as
/// possible. Where that is impossible (a Moebius strip), some edges stay as they were. Edges of three and more faces
/// connect nothing.
/// @return  the faces that were turned, ascending; their first corners stay
/// @throws InvalidMesh  bad connectivity
std::vector<Index> orient_faces(Mesh& mesh);

}  // namespace sublimit
