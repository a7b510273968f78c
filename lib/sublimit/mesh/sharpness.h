// SPDX-License-Identifier: Apache-2.0
#pragma once
// Semi-sharp creases of all schemes: the sharpness of edges and vertices, its decay from level to level, the rule that
// a vertex or edge takes, and the blending of two rules while sharpness decays to 0.
//
//   const Topology topology(view(mesh));
//   const Sharpness sharp = initial_sharpness(topology, mesh, Boundary::edge_only, Creasing::uniform);
//   const Rule rule = VertexSharpness(topology, sharp, Vertex{0}).rule();
//
// Sharpness is counted in levels and kept in float, as OpenSubdiv keeps it: double would differ from it by 1e-9.
// Sources: Hoppe et al. 1994; DeRose, Kass, Truong 1998 (semi-sharp, Chaikin decay); the blending of rules is
// OpenSubdiv's.
#include <span>
#include <utility>
#include <vector>

#include "sublimit/mesh/mesh.h"
#include "sublimit/mesh/topology.h"

namespace sublimit {

/// Least sharpness that never decays.
inline constexpr float infinite_sharpness = 10;
/// True if the rule for sharp elements applies.
constexpr bool is_sharp(float sharpness) { return sharpness > 0; }
/// True if sharpness does not decay.
constexpr bool is_infinite(float sharpness) { return sharpness >= infinite_sharpness; }
/// True if an element is sharp for a finite number of levels.
constexpr bool is_semi_sharp(float sharpness) { return is_sharp(sharpness) && !is_infinite(sharpness); }

/// Sharpness of every edge and vertex of one level, in levels. Plain data.
struct Sharpness {
  UninitializedVector<float> edge, vertex;
  Creasing creasing = Creasing::uniform;
};

/// Rule of a vertex, by its sharp edges: none, one, two, more (or a sharp vertex).
enum class Rule { smooth, dart, crease, corner };

/// Sharpness of a vertex and its edges before and after one step, and the rules that follow. A value.
class VertexSharpness {
 public:
  /// Makes it from the sharpness of a vertex and of its edges.
  VertexSharpness(float vertex, std::vector<float> edges, Creasing creasing);
  /// Makes it from the sharpness of a level; edges are in the order of `Topology::edges(v)`.
  VertexSharpness(const Topology& topology, const Sharpness& sharpness, Vertex v);

  /// Returns the rule before the step.
  Rule rule() const { return rule_of(vertex, edges); }
  /// Returns the rule after the step.
  Rule child_rule() const { return rule_of(child_vertex, child_edges); }
  /// Returns the weight of the parent's rule if the child's differs: the mean sharpness of the incident edges, and of
  /// the vertex itself, that decay to 0 in this step; at most 1.
  float parent_weight() const;

  float vertex, child_vertex;             ///< sharpness of the vertex before and after the step
  std::vector<float> edges, child_edges;  ///< sharpness of its edges before and after the step

  /// Returns the rule of a vertex with a sharpness, and edges with theirs.
  static Rule rule_of(float vertex, std::span<const float> edges);
};

/// Returns the positions of the first and the last sharp edge in a list, the two edges of a crease.
std::pair<Index, Index> crease_ends(std::span<const float> edges);

/// Returns the sharpness after one step of a vertex, or of an edge under uniform creasing.
float decayed(float sharpness);

/// Returns the sharpness of level 0: that of the tags, and that of boundaries and non-manifold elements.
///
/// Boundary and non-manifold edges are infinitely sharp. A vertex of a single face is a corner under edge_and_corner. A
/// non-manifold or isolated vertex is a corner, unless it has exactly two non-manifold edges, no boundary edge and more
/// faces than edges: then its edges make it a crease.
/// @throws InvalidMesh  a tag that names no vertex or edge, negative or non-finite sharpness
Sharpness initial_sharpness(const Topology& topology, const Mesh& tags, Boundary boundary, Creasing creasing);

/// Returns for each face whether it is a hole: tagged faces and, under Boundary::none, all faces that touch the
/// boundary at a vertex with a boundary edge whose tags are less than infinitely sharp. (A boundary that is infinitely
/// sharp by its tags needs no neighbours.)
/// @throws InvalidMesh  a tag that names no face
std::vector<bool> initial_holes(const Topology& topology, const Mesh& tags, Boundary boundary);

/// True if the surface ends at this edge or is cut by it: there is no face beyond, or the crease is infinitely sharp.
/// At a vertex with a single such edge, which is not on the boundary, both sides of the edge are one.
inline bool is_cut(const Topology& t, const Sharpness& sharpness, HalfEdge h) {
  return !exists(t.twin(h)) || is_infinite(sharpness.edge[index(t.edge(h))]);
}

/// Returns the edge between two vertices, in either direction: the first one if there are several, -1 if there is none.
Edge find_edge(const Topology& topology, Vertex a, Vertex b);

/// Makes edges of two faces whose normals differ by more than an angle infinitely sharp. Tags that the mesh has win.
/// Faces without an area have no normal, and their edges stay as they are.
/// @param angle  radians, 0 to pi
/// @return  the number of edges
/// @throws InvalidMesh, InvalidParameter
Index add_creases_by_angle(Mesh& mesh, double angle);

/// Makes edges between faces of different smoothing groups infinitely sharp; faces in none ("off", "0") are in no
/// common group. Tags that the mesh has win.
/// @return  the number of edges
/// @throws InvalidMesh  bad connectivity, or no face has a smoothing group
Index add_creases_by_smoothing_groups(Mesh& mesh);

/// Makes all border vertices infinitely sharp corners: the border stays the polygon that it is.
/// @throws InvalidMesh  bad connectivity
void fix_border(Mesh& mesh);

}  // namespace sublimit
