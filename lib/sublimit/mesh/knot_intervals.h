// SPDX-License-Identifier: Apache-2.0
#pragma once
// Knot intervals of a mesh, as non-uniform B-splines of degree 3 have them: the distance between the knots at the two
// ends of an edge. Opposite edges of a quadrilateral have one interval; edges that are so tied to each other are a
// strip, and the points along each of its two sides a rail.
//
// Where new knots go decides what a level becomes. Halves leave intervals around extraordinary vertices unequal for
// ever; levelling puts the new knots of a strip with extraordinary vertices on one of its rails so near to them that
// all intervals there are one after two levels, and the next ring's after three.
//
// In degree 2 an interval belongs to a point: the knots of two neighbours meet on the edge between them. Each end of an
// edge has one, and opposite ends at a vertex of four edges are one interval; extraordinary are the faces, around which
// levelling does the same.
// Source: Sederberg, Zheng, Sewell, Sabin 1998, "Non-uniform recursive subdivision surfaces"; selective insertion
// around extraordinary vertices: Cashman, Augsdoerfer, Dodgson, Sabin 2009, "NURBS with extraordinary points".
#include <cstdint>
#include <vector>

#include "sublimit/mesh/control_mesh.h"
#include "sublimit/mesh/topology.h"

namespace sublimit {

/// Where a scheme puts new knots.
enum class NewKnots {
  none,       ///< it knows no intervals
  halving,    ///< in the middle
  levelling,  ///< towards equal intervals around extraordinary vertices
};

/// What intervals belong to: one entry for each edge (degree 3), or two (degree 2), of its tail and of its head.
enum class KnotOwner { edge, point };

/// The entry of an edge: of degree 2 the one at this end.
inline size_t knot_entry(KnotOwner owner, Edge edge, bool at_tail) {
  const auto e = static_cast<size_t>(index(edge));
  return owner == KnotOwner::edge ? e : 2 * e + (at_tail ? 0 : 1);
}
/// The entry of the edge of a half-edge: of degree 2 the one at its tail.
inline size_t knot_entry(KnotOwner owner, const Topology& t, HalfEdge h) {
  return knot_entry(owner, t.edge(h), t.forward(h));
}
/// Returns the entry at the other end of the same edge; degree 2.
inline size_t other_end(size_t entry) { return entry ^ 1; }

/// Intervals of one level.
struct KnotIntervals {
  KnotOwner owner = KnotOwner::edge;
  std::vector<double> length;  ///< per entry, > 0; empty: all are equal
  /// Levelling, per entry. Bits, of edges: the rail at its tail, at its head has extraordinary vertices; the rail
  /// between its halves will have them, in the tail's half, in the head's. Of points: the knot on the edge has
  /// extraordinary faces or vertices, the knot beyond the point has them.
  std::vector<std::uint8_t> ends;
  double least = 0;    ///< levelling: what intervals of extraordinary vertices become, before they are halved with all
  bool plain = false;  ///< levelling: polygons other than quadrilaterals are cut in halves first

  bool empty() const { return length.empty(); }
};

/// The new knots of one step.
struct KnotSplit {
  KnotOwner owner = KnotOwner::edge;
  std::vector<double> length;  ///< interval per entry
  /// Distance of the new knot: of edges from their tail, of points from the knot on the edge.
  std::vector<double> distance;
};

/// Intervals of level 0: the mesh's, carried along their strips; 1 where it has none.
/// @throws InvalidMesh  naming edges and faces: an interval that is no positive number, of no edge, two of one strip,
/// or
///                      (of edges) polygons other than quadrilaterals with unequal ones
KnotIntervals initial_intervals(const Topology& topology, const ControlMesh& mesh, NewKnots rule, KnotOwner owner);

/// Fills `ends` of intervals of points, from what is extraordinary in the mesh.
void find_point_ends(const Topology& topology, KnotIntervals& intervals);

KnotSplit new_knots(const KnotIntervals& intervals);

/// Empty from here on where intervals are equal and stay so.
void simplify(KnotIntervals& intervals);

/// Intervals of other edges: those of a part of a mesh, or of a channel of values on it.
/// @param whole_half  of a half-edge of `part`: the half-edge of `whole` that it is
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
