// SPDX-License-Identifier: Apache-2.0
#pragma once
// Semi-sharp creases, once for all schemes: how sharp edges and vertices are, how sharpness decays, which rule a vertex
// or edge takes, and how two rules blend while sharpness runs out.
//
// Sharpness is counted in levels and kept in float, as OpenSubdiv keeps it: double would differ from it by 1e-9.
// Sources: Hoppe et al. 1994; DeRose, Kass, Truong 1998 (semi-sharp, Chaikin decay); the blending of rules is
// OpenSubdiv's.
#include <span>
#include <utility>
#include <vector>

#include "sublimit/mesh/control_mesh.h"
#include "sublimit/mesh/topology.h"

namespace sublimit {

inline constexpr float infinite_sharpness = 10;
constexpr bool is_sharp(float sharpness) { return sharpness > 0; }
constexpr bool is_infinite(float sharpness) { return sharpness >= infinite_sharpness; }
constexpr bool is_semi_sharp(float sharpness) { return is_sharp(sharpness) && !is_infinite(sharpness); }

/// Sharpness of every edge and vertex of one level.
struct Sharpness {
  UninitializedVector<float> edge, vertex;
  Creasing creasing = Creasing::uniform;
};

enum class Rule { smooth, dart, crease, corner };

/// The edges at one vertex with their sharpness now and after one step, and the rules that follow.
class VertexSharpness {
 public:
  VertexSharpness(float vertex, std::vector<float> edges, Creasing creasing);
  VertexSharpness(const Topology& topology, const Sharpness& sharpness, Vertex v);

  Rule rule() const { return rule_of(vertex, edges); }
  Rule child_rule() const { return rule_of(child_vertex, child_edges); }
  /// Weight of the parent's rule where the child's differs: the mean sharpness of everything that decays to 0 in this
  /// step, the incident edges and the vertex itself, at most 1.
  float parent_weight() const;

  float vertex, child_vertex;
  std::vector<float> edges, child_edges;

  static Rule rule_of(float vertex, std::span<const float> edges);
};

/// First and last sharp edge: the two ends of a crease.
std::pair<Index, Index> crease_ends(std::span<const float> edges);

/// Sharpness of a vertex, or of an edge under uniform creasing, one level on.
float decayed(float sharpness);

/// Sharpness of level 0: the tags, and what connectivity makes sharp.
///
/// Boundary and non-manifold edges are infinitely sharp. A vertex of a single face is a corner under edge_and_corner. A
/// non-manifold or isolated vertex is a corner, unless it has exactly two non-manifold edges, no boundary edge and more
/// faces than edges: then its edges make it a crease.
/// @throws InvalidMesh  a tag that names no vertex or edge, negative or non-finite sharpness
Sharpness initial_sharpness(const Topology& topology, const ControlMesh& tags, Boundary boundary, Creasing creasing);

/// Which faces are holes: the tagged ones and, under Boundary::none, all that touch the boundary at a vertex with a
/// boundary edge that the tags leave less than infinitely sharp. (A boundary that is sharp by its tags needs no
/// neighbours.)
/// @throws InvalidMesh  a tag that names no face
std::vector<bool> initial_holes(const Topology& topology, const ControlMesh& tags, Boundary boundary);

/// The surface has two sides at this edge, or ends: there is no face beyond, or a crease that never gets smooth. Where
/// a vertex has a single such edge inside, they are the same side.
inline bool is_cut(const Topology& t, const Sharpness& sharpness, HalfEdge h) {
  return !exists(t.twin(h)) || is_infinite(sharpness.edge[index(t.edge(h))]);
}

/// Edge between two vertices, the first one where there are several (`tail`, `head` in either order); -1 if there is
/// none.
Edge find_edge(const Topology& topology, Vertex a, Vertex b);

}  // namespace sublimit
