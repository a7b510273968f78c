// SPDX-License-Identifier: Apache-2.0
#pragma once
// Splits: the connectivity of one refinement step, without weights or geometry.
//
//   const Topology coarse(view(mesh));
//   const Refinement fine = refine(coarse, Split::pqq);
//   const Vertex middle = fine.child(Edge{0});  // the new vertex of edge 0
//   std::cout << fine.topology.num_faces() << " faces\n";
#include <utility>
#include <vector>

#include "sublimit/core/types.h"
#include "sublimit/mesh/topology.h"

namespace sublimit {

/// The split of a scheme.
enum class Split {
  pqq,       ///< primal quadrilateral: an n-gon becomes n quads around a face point
  ptq,       ///< primal triangular: a triangle becomes four
  dqq,       ///< dual quadrilateral: a point for each corner of a face; faces from faces, edges and vertices
  mid_edge,  ///< a point for each edge; faces from faces and vertices
  sqrt3,     ///< a triangle becomes three around a face point, and old edges flip
  dual,      ///< a point for each face, a face for each vertex
  quads,     ///< a point for each face, a quad for each edge from its ends and its faces' points
  keep,      ///< the same connectivity: points move, nothing else
};

/// Returns the name of a split, as the program writes it.
const char* name(Split split);

/// One step of refinement: connectivity of the child, and the parent of each of its elements. Plain data.
///
/// Dual splits (dqq, mid_edge, dual) and sqrt3 cut non-manifold edges into sheets: "border" below is a half-edge
/// without twin.
struct [[nodiscard]] Refinement {
  /// Parent element of a child vertex. `corner`: a corner of a face, numbered as its half-edge; `border`: a half-edge
  /// without twin.
  enum class Origin { vertex, face, edge, corner, border };

  Topology topology;  ///< connectivity of the child

  /// Numbers of child vertices in each group, in this order: from vertices, faces, edges, corners, then borders; each
  /// group is in the parents' order. A group that the split does not make is empty.
  Index from_vertices = 0, from_faces = 0, from_edges = 0, from_corners = 0;
  /// Parents of the children of a group, if not every element has one: vertices that mid_edge keeps, faces that sqrt3
  /// does not cut from their border, edges in sheets. Empty if child i has parent i.
  std::vector<Index> vertex_list, face_list, edge_list;
  std::vector<Index> borders;  ///< half-edges without twin, ascending
  Index border_points = 0;     ///< children of each of them, from its tail on

  /// Numbers of child faces in each group, in this order: from faces (for sqrt3 from half-edges), from edges, then from
  /// vertices.
  Index faces_from_faces = 0, faces_from_edges = 0;

  /// Dual splits: child face of each vertex, the last one if it has several; -1: none.
  std::vector<Index> face_of_vertex;
  UninitializedVector<Index> face_parent;  ///< a parent face of every child face: its own, or one at its edge or vertex

  /// Returns the child vertex of an element, if every element of its kind has one.
  Vertex child(Vertex v) const { return Vertex{index(v)}; }
  Vertex child(Face f) const { return Vertex{from_vertices + index(f)}; }
  Vertex child(Edge e) const { return Vertex{from_vertices + from_faces + index(e)}; }
  Vertex child(HalfEdge corner) const { return Vertex{from_vertices + from_faces + from_edges + index(corner)}; }
  /// Returns the number of child vertices.
  Index num_children() const { return first_border_child() + border_points * static_cast<Index>(borders.size()); }
  Index first_border_child() const { return from_vertices + from_faces + from_edges + from_corners; }

  /// Returns the kind of a child vertex's parent.
  Origin origin(Vertex child) const {
    Index i = index(child) - from_vertices;
    if (i < 0) return Origin::vertex;
    if ((i -= from_faces) < 0) return Origin::face;
    if ((i -= from_edges) < 0) return Origin::edge;
    return i < from_corners ? Origin::corner : Origin::border;
  }
  /// Returns the number of the parent of a child vertex: a vertex, face, edge or half-edge (see `origin`).
  Index parent(Vertex child) const {
    Index i = index(child);
    if (i < from_vertices) return vertex_list.empty() ? i : vertex_list[i];
    if ((i -= from_vertices) < from_faces) return face_list.empty() ? i : face_list[i];
    if ((i -= from_faces) < from_edges) return edge_list.empty() ? i : edge_list[i];
    if ((i -= from_edges) < from_corners) return i;
    return borders[(i - from_corners) / border_points];
  }
  /// Returns the position of a border child among the points of its half-edge, 0 at the tail.
  Index part(Vertex child) const { return (index(child) - first_border_child()) % border_points; }

  /// Returns the two child half-edges of a half-edge in a primal split: from its tail to the midpoint, and from there
  /// to its head.
  std::pair<HalfEdge, HalfEdge> halves(const Topology& parent, HalfEdge h) const;

  Split split = Split::pqq;
};

/// Returns the refinement of a mesh by one split.
///
/// Children of a face stand together, in the parents' order; a child keeps the orientation of its parent's corners:
/// child i of a quad or triangle has the child of corner i at position i, child i of any other face has it at position
/// 0, and the middle triangle has the midpoint opposite to corner i at position i. sqrt3: child h has the tail of
/// half-edge h first.
/// @param level  level of the parent: sqrt3 keeps the boundary in even levels and trisects it in odd ones; mid_edge
///               keeps boundary vertices in even levels and cuts them off in odd ones
/// @throws UnsupportedTopology  ptq, sqrt3 on a face that is not a triangle
/// @throws ResourceError        more half-edges than 32-bit indices; checked before memory is taken
Refinement refine(const Topology& parent, Split split, int level = 0);

/// True for the primal splits pqq and ptq, which have `numbering` and `child_corners`.
constexpr bool is_primal(Split split) { return split == Split::pqq || split == Split::ptq; }
/// Returns the refinement of a mesh by a primal split without connectivity: `topology` of the result is empty.
/// @throws as `refine`
Refinement numbering(const Topology& parent, Split split);
/// Returns the vertices of all child faces of a primal split, four or three each, in the order of `refine`: all that is
/// needed of the last level.
/// @param numbering  result of `numbering`
std::vector<Index> child_corners(const Topology& parent, const Refinement& numbering);

/// Throws unless all faces are triangles.
/// @throws UnsupportedTopology  names the first face that is not a triangle
void check_triangles(const Topology& topology);

/// Returns the number of half-edges that `refine` would make; for a mesh with borders an upper bound.
std::int64_t num_child_half_edges(const Topology& parent, Split split);

/// Returns for each child face whether it is a hole: faces from holes, and faces from edges and vertices that have only
/// holes around them.
/// @param holes  true for each parent face that is a hole
std::vector<bool> refine_holes(const std::vector<bool>& holes, const Topology& parent, const Refinement& refinement);

}  // namespace sublimit
