// SPDX-License-Identifier: Apache-2.0
#pragma once
// Knot intervals of a mesh, for non-uniform schemes: in degree 3 the distance between the knots at the two ends of an
// edge.
//
//   Mesh mesh = read_mesh("grid.obj");
//   mesh.knot_intervals.push_back({.tail = 0, .head = 1, .length = 0.5});  // and of the edge's strip
//   const Topology topology(view(mesh));
//   const KnotIntervals intervals = initial_intervals(topology, mesh, NewKnots::halving, KnotOwner::edge);
//   const KnotSplit knots = new_knots(intervals);  // of the step to level 1
//
// Opposite edges of a quadrilateral have one interval; edges that are so tied to each other are a
// strip, and the points along each of its two sides a rail.
//
// Halving leaves intervals around extraordinary vertices unequal on every level. Levelling puts the new knots of a
// strip with extraordinary vertices on one of its rails so near to them that all intervals there are equal after two
// levels, and those of the next ring after three.
//
// In degree 2 an interval belongs to a point: the knots of two neighbours meet on the edge between them. Each end of an
// edge has one, and opposite ends at a vertex of four edges share it. Faces are extraordinary instead of vertices, and
// levelling makes the intervals around them equal.
// Source: Sederberg, Zheng, Sewell, Sabin 1998, "Non-uniform recursive subdivision surfaces"; selective insertion
// around extraordinary vertices: Cashman, Augsdoerfer, Dodgson, Sabin 2009, "NURBS with extraordinary points".
#include <cstdint>
#include <vector>

#include "sublimit/mesh/mesh.h"
#include "sublimit/mesh/topology.h"

namespace sublimit {

/// Where a scheme inserts new knots.
enum class NewKnots {
  none,       ///< the scheme does not use intervals
  halving,    ///< in the middle
  levelling,  ///< towards equal intervals around extraordinary vertices
};

/// Elements that intervals belong to: one entry for each edge (degree 3), or two, at its tail and its head (degree 2).
enum class KnotOwner { edge, point };

/// Returns the number of the entry of an edge; in degree 2 of the one at its tail or head.
inline size_t knot_entry(KnotOwner owner, Edge edge, bool at_tail) {
  const auto e = static_cast<size_t>(index(edge));
  return owner == KnotOwner::edge ? e : 2 * e + (at_tail ? 0 : 1);
}
/// Returns the number of the entry of the edge of a half-edge; in degree 2 of the one at the half-edge's tail.
inline size_t knot_entry(KnotOwner owner, const Topology& t, HalfEdge h) {
  return knot_entry(owner, t.edge(h), t.forward(h));
}
/// Returns the number of the entry at the other end of the same edge, in degree 2.
inline size_t other_end(size_t entry) { return entry ^ 1; }

/// Intervals of one level. Plain data.
struct KnotIntervals {
  KnotOwner owner = KnotOwner::edge;
  std::vector<double> length;  ///< interval of each entry, > 0; empty: all are equal
  /// Levelling: four bits for each entry of an edge. Bit 0: the rail at its tail has extraordinary vertices; bit 1: the
  /// rail at its head; bits 2 and 3: the rail between its halves will have them, in the half of the tail, of the head.
  /// Two bits for each entry of a point: the knot on the edge has extraordinary faces or vertices; the knot beyond the
  /// point has them.
  std::vector<std::uint8_t> ends;
  double least = 0;  ///< levelling: common interval around extraordinary vertices, before it is halved with all others
  bool plain = false;  ///< levelling: polygons other than quadrilaterals are split at the middles of their edges first

  bool empty() const { return length.empty(); }
};

/// New knots of one step. Plain data.
struct KnotSplit {
  KnotOwner owner = KnotOwner::edge;
  std::vector<double> length;  ///< interval of each entry
  std::vector<double>
      distance;  ///< distance of its new knot from the edge's tail, in degree 2 from the knot on the edge
};

/// Returns the intervals of level 0: those of the mesh, carried along their strips, and 1 elsewhere.
/// @throws InvalidMesh  an interval that is not a positive number or not of an edge, different ones in one strip,
///                      or (in degree 3) polygons other than quadrilaterals with unequal ones: names edges and
///                      faces
KnotIntervals initial_intervals(const Topology& topology, const Mesh& mesh, NewKnots rule, KnotOwner owner);

/// Fills `ends` of intervals of points, from the extraordinary faces and vertices of the mesh.
void set_point_ends(const Topology& topology, KnotIntervals& intervals);

/// Returns the new knots of the step to the next level.
KnotSplit new_knots(const KnotIntervals& intervals);

/// Clears intervals that are all equal and stay so.
void simplify(KnotIntervals& intervals);

/// Returns intervals in the numbering of another topology: a part of a mesh, or a channel of values on it.
/// @param whole_half  returns the half-edge of `whole` that a half-edge of `part` is
template <class WholeHalf>
KnotIntervals renumbered(const KnotIntervals& intervals, const Topology& whole, const Topology& part,
                         const WholeHalf& whole_half) {
  KnotIntervals result = intervals;
  if (intervals.empty()) return result;
  const bool has_ends = !intervals.ends.empty(), of_points = intervals.owner == KnotOwner::point;
  const auto count = size_t(part.num_edges()) * (of_points ? 2 : 1);
  result.length.assign(count, 0);
  if (has_ends) result.ends.assign(count, 0);
  for (Index i = 0; i < part.num_edges(); ++i) {
    // The edge runs as its first half-edge does.
    const HalfEdge own = part.half_edge(Edge{i}), h{whole_half(own)};
    const size_t to = knot_entry(result.owner, part, own), from = knot_entry(result.owner, whole, h);
    result.length[to] = intervals.length[from];
    if (of_points) result.length[other_end(to)] = intervals.length[other_end(from)];
    if (!has_ends) continue;
    const unsigned ends = intervals.ends[from];
    if (of_points) {
      result.ends[to] = intervals.ends[from];
      result.ends[other_end(to)] = intervals.ends[other_end(from)];
    } else {
      // Bits 0 and 1, and 2 and 3, change places where the edge runs the other way.
      result.ends[to] = static_cast<std::uint8_t>(whole.forward(h) ? ends : (ends & 5) << 1 | (ends & 10) >> 1);
    }
  }
  simplify(result);
  return result;
}

}  // namespace sublimit
