// SPDX-License-Identifier: Apache-2.0
#pragma once
// Sheets one by one. At a non-manifold vertex several fans of faces meet; mostly the vertex stays where it is, or moves
// along a crease that all of them have, and then none of them knows what the others are: 64 sheets of a crowded edge
// are 64 borders.
#include <span>

#include "sublimit/scheme/refine.h"

namespace sublimit {

/// True if all that a step makes at a non-manifold vertex depends, for each fan, on what that fan has: the vertex stays
/// where it is for ever, or every sharp edge there, infinitely so, is at every fan. Chaikin's mean of semi-sharp edges
/// is taken over all fans.
/// @return  false for other vertices
bool are_sheets_apart(const Topology& topology, const Sharpness& sharpness, Vertex v);

/// True if a level may be looked at sheet by sheet: intervals between knots go on from sheet to sheet, a mask of border
/// edges that looks inside (`wide_borders`) looks at one sheet for all, and where edges turn from level to level
/// (sqrt(3)), those in which sheets meet do not.
bool may_part_sheets(const Level& level);

/// Calls visit(half-edge) for those with the same tail on the same sheet, counter-clockwise.
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

/// Takes a part as `part` does, but rings go around a vertex whose sheets are apart on those sheets alone that have
/// been met.
Part sheet_part(const Level& whole, std::span<const Index> faces, int rings);

}  // namespace sublimit
