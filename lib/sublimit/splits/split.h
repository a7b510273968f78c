// SPDX-License-Identifier: Apache-2.0
#pragma once
// Splits: the topology of one refinement step. No weights here, and no geometry.
#include <utility>
#include <vector>

#include "sublimit/core/types.h"
#include "sublimit/mesh/topology.h"

namespace sublimit {

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

/// What the program calls a split.
const char* name(Split split);

/// One level of refinement: the child's connectivity and where every child element comes from.
///
/// Dual splits (dqq, mid_edge, dual) and sqrt3 cut non-manifold edges into sheets: "border" below is a half-edge
/// without twin.
struct [[nodiscard]] Refinement {
  /// corner: of a face, known by its half-edge; border: a point of a half-edge without twin.
  enum class Origin { vertex, face, edge, corner, border };

  Topology topology;  ///< of the child

  /// Child vertices in this order: from vertices, faces, edges, corners, borders, each group in the parents' order. A
  /// group that the split does not make is empty.
  Index from_vertices = 0, from_faces = 0, from_edges = 0, from_corners = 0;
  /// Parents where a group does not hold one child for each: vertices that mid_edge keeps, faces that sqrt3 does not
  /// cut from their border, edges in sheets.
  std::vector<Index> vertex_list, face_list, edge_list;
  std::vector<Index> borders;  ///< half-edges without twin, ascending
  Index border_points = 0;     ///< for each of them, from its tail on

  /// Child faces in this order: from faces (for sqrt3 from half-edges), from edges, from vertices.
  Index faces_from_faces = 0, faces_from_edges = 0;

  std::vector<Index>
      face_of_vertex;  ///< dual: child face of each vertex, -1 where there is none (the last one's of several)
  UninitializedVector<Index> face_parent;  ///< a parent face of every child face: its own, or one at its edge or vertex

  Vertex child(Vertex v) const { return Vertex{index(v)}; }
  Vertex child(Face f) const { return Vertex{from_vertices + index(f)}; }
  Vertex child(Edge e) const { return Vertex{from_vertices + from_faces + index(e)}; }
  Vertex child(HalfEdge corner) const { return Vertex{from_vertices + from_faces + from_edges + index(corner)}; }
  Index num_children() const { return first_border_child() + border_points * static_cast<Index>(borders.size()); }
  Index first_border_child() const { return from_vertices + from_faces + from_edges + from_corners; }

  Origin origin(Vertex child) const {
    Index i = index(child) - from_vertices;
    if (i < 0) return Origin::vertex;
    if ((i -= from_faces) < 0) return Origin::face;
    if ((i -= from_edges) < 0) return Origin::edge;
    return i < from_corners ? Origin::corner : Origin::border;
  }
  /// Parent vertex, face, edge or half-edge (see `origin`) of a child vertex.
  Index parent(Vertex child) const {
    Index i = index(child);
    if (i < from_vertices) return vertex_list.empty() ? i : vertex_list[i];
    if ((i -= from_vertices) < from_faces) return face_list.empty() ? i : face_list[i];
    if ((i -= from_faces) < from_edges) return edge_list.empty() ? i : edge_list[i];
    if ((i -= from_edges) < from_corners) return i;
    return borders[(i - from_corners) / border_points];
  }
  /// Which of its half-edge's points a border child is: 0 at the tail.
  Index part(Vertex child) const { return (index(child) - first_border_child()) % border_points; }

  /// The two child half-edges that a parent half-edge becomes in a primal split: from its vertex to the midpoint, and
  /// on to its head.
  std::pair<HalfEdge, HalfEdge> halves(const Topology& parent, HalfEdge h) const;

  Split split = Split::pqq;
};

/// One level of `split` applied to a mesh.
///
/// Children of a face stand together, in the parents' order; a child keeps the orientation of its parent's corners:
/// child i of a quad or triangle has the child of corner i at position i, child i of any other face has it at position
/// 0, and the middle triangle has the midpoint opposite to corner i at position i. sqrt3: child h has the tail of
/// half-edge h first.
/// @param level  of the parent: sqrt3 leaves the boundary alone in even levels and trisects it in odd ones; mid_edge
/// keeps
///               boundary vertices in even levels and cuts them off in odd ones
/// @throws UnsupportedTopology  ptq, sqrt3 on a face that is not a triangle
/// @throws ResourceError        more half-edges than 32-bit indices; checked before memory is taken
Refinement refine(const Topology& parent, Split split, int level = 0);

/// Whether a split has `numbering` and `child_corners`: the primal ones, pqq and ptq.
constexpr bool is_primal(Split split) { return split == Split::pqq || split == Split::ptq; }
/// How a primal split numbers its children, without their connectivity: `topology` is empty.
/// @throws as `refine`
Refinement numbering(const Topology& parent, Split split);
/// Corners of all faces that a primal split makes, four or three each, as `refine` has them: all that is needed of a
/// level that nothing refines further.
std::vector<Index> child_corners(const Topology& parent, const Refinement& numbering);

/// @throws UnsupportedTopology  naming the first face that is not a triangle
void check_triangles(const Topology& topology);

/// Corners of the child mesh: what `refine` would need, without doing it; of a mesh with borders at most.
std::int64_t num_child_half_edges(const Topology& parent, Split split);

/// Which children of holes are holes: faces from faces of holes, and faces from edges and vertices with holes all
/// around.
std::vector<bool> refine_holes(const std::vector<bool>& holes, const Topology& parent, const Refinement& refinement);

}  // namespace sublimit
