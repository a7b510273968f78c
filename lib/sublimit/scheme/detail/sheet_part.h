// SPDX-License-Identifier: Apache-2.0
#pragma once
// Separate treatment of sheets. At a non-manifold vertex several fans of faces (sheets) meet. Usually the
// vertex is fixed, or moves along a crease that all sheets share; then no sheet depends on the others, so that,
// for example, 64 sheets at a common edge are 64 separate borders.
#include <span>

#include "sublimit/scheme/refine.h"

namespace sublimit {

/// True if sheets at a non-manifold vertex are independent: the vertex is fixed on all levels, or every sharp
/// edge there is infinitely sharp and belongs to every fan. (With semi-sharp edges, Chaikin's mean is taken
/// over all fans.)
/// @return  false for other vertices
bool are_sheets_apart(const Topology& topology, const Sharpness& sharpness, Vertex v);

/// True if sheets of a level may be treated separately. False for manifold meshes; with knot intervals, which
/// continue from sheet to sheet; with border masks that depend on the interior (`wide_borders`), which use one
/// sheet for all; and for periods above 1 (sqrt3), where edges rotate from level to level, except those at
/// which sheets meet.
bool may_part_sheets(const Level& level);

/// Calls visit(half-edge) for the half-edges with the same tail on the same sheet, counter-clockwise.
template <class Visit>
void for_each_in_fan(const Topology& t, HalfEdge from, const Visit& visit) {
  HalfEdge first = from;
  while (exists(t.twin(first))) {
    first = t.next(t.twin(first));
    if (first == from) break;
  }
  HalfEdge h = first;
  do {
    visit(h);
    h = t.ccw(h);
  } while (exists(h) && h != first);
}

/// Returns a part of a level as `part`, but at vertices with separate sheets rings include only sheets that
/// have been reached.
Part sheet_part(const Level& whole, std::span<const Index> faces, int rings);

}  // namespace sublimit
