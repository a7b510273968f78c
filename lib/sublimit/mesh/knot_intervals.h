// SPDX-License-Identifier: Apache-2.0
#pragma once
// Knot intervals of a mesh, as non-uniform B-splines of degree 3 have them: the distance between the knots at the two
// ends of an edge. Opposite edges of a quadrilateral have one interval; edges that are so tied to each other are a
// strip, and the points along each of its two sides a rail.
//
// Where new knots go decides what a level becomes. Halves leave intervals around extraordinary vertices unequal for
// ever; levelling puts the new knots of a strip with extraordinary vertices on one of its rails so near to them that
// all intervals there are one after two levels, and the next ring's after three.
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

/// Intervals of the edges of one level.
struct KnotIntervals {
  std::vector<double> length;  ///< per edge, > 0; empty: all are equal
  /// Levelling, per edge. Bits: the rail at its tail, at its head has extraordinary vertices; the rail between its
  /// halves will have them, in the tail's half, in the head's.
  std::vector<std::uint8_t> ends;
  double least = 0;    ///< levelling: what intervals of extraordinary vertices become, before they are halved with all
  bool plain = false;  ///< levelling: polygons other than quadrilaterals are cut in halves first

  bool empty() const { return length.empty(); }
};

/// The new knots of one step.
struct KnotSplit {
  std::vector<double> length;   ///< interval per edge
  std::vector<double> at_tail;  ///< distance of the new knot from the edge's tail
};

/// Intervals of level 0: the mesh's, carried along their strips; 1 where it has none.
/// @throws InvalidMesh  naming edges and faces: an interval that is no positive number, of no edge, two of one strip,
/// or
///                      polygons other than quadrilaterals with unequal ones
KnotIntervals initial_intervals(const Topology& topology, const ControlMesh& mesh, NewKnots rule);

KnotSplit new_knots(const KnotIntervals& intervals);

/// Empty from here on where intervals are equal and stay so.
void simplify(KnotIntervals& intervals);

/// Intervals of other edges: those of a part of a mesh, or of a channel of values on it.
/// @param whole_half  of a half-edge of `part`: the half-edge of `whole` that it is
template <class WholeHalf>
KnotIntervals renumbered(const KnotIntervals& intervals, const Topology& whole, const Topology& part,
                         const WholeHalf& whole_half) {
  KnotIntervals result{.length = {}, .ends = {}, .least = intervals.least, .plain = intervals.plain};
  if (intervals.empty()) return result;
  const bool has_ends = !intervals.ends.empty();
  result.length.resize(part.num_edges());
  if (has_ends) result.ends.resize(part.num_edges());
  for (Index i = 0; i < part.num_edges(); ++i) {
    // The edge runs as its first half-edge does.
    const HalfEdge h{whole_half(part.half_edge(Edge{i}))};
    const Index e = index(whole.edge(h));
    result.length[i] = intervals.length[e];
    if (!has_ends) continue;
    const unsigned ends = intervals.ends[e];
    // Bits 0 and 1, and 2 and 3, change places where the edge runs the other way.
    result.ends[i] = static_cast<std::uint8_t>(whole.forward(h) ? ends : (ends & 5) << 1 | (ends & 10) >> 1);
  }
  simplify(result);
  return result;
}

}  // namespace sublimit
