// SPDX-License-Identifier: Apache-2.0
#pragma once
// Following a place on a limit surface through the children of its face. Addresses are binary numbers, so that
// 256 bits hold every place exactly. Uses only topology, that is indices of the splits, but no masks.
#include <span>

#include "sublimit/source/address.h"
#include "sublimit/splits/split.h"
#include "truth/precise.h"

namespace sublimit::testing {

/// A square or triangle of some level that contains the place, and the place in it.
struct DescentPlace {
  enum class Cell {
    square,         ///< a quad; `frame` starts at (0,0) and runs to (1,0)
    corner,         ///< square at a corner of a polygon, as in addresses: `frame` starts there
    triangle,       ///< `frame` starts at (0,0) and runs to (1,0)
    around_vertex,  ///< dual schemes: the square between the centres of the four faces around a vertex; `frame` starts
                    ///< at the vertex, its face's centre is (0,0), and those of the next faces, counter-clockwise, are
                    ///< (1,0), (1,1), (0,1)
  };
  Cell cell = Cell::square;
  HalfEdge frame = no_half_edge;
  Precise x = 0, y = 0;
  Precise scale = 1;  ///< d(x,y) / d(u,v), a multiple of the identity
};

/// Returns the face and place of an address.
/// @throws InvalidParameter  no such address, or a place outside it
DescentPlace place_of(const Topology& control, bool triangles, const Place& place);

/// A refinement, with the topology that it refined.
struct TakenStep {
  const Topology* parent = nullptr;
  const Refinement* refinement = nullptr;
};

/// Returns the place in the mesh after the steps of a level, or of two levels for schemes that rotate the grid
/// (sqrt3, mid-edge).
/// @throws UnsupportedTopology  faces cut by Split::quads, for which addresses have no natural meaning
DescentPlace descend(const DescentPlace& place, std::span<const TakenStep> steps);

/// Returns the half-edge `quarters` steps counter-clockwise around a vertex with four faces.
inline HalfEdge turned(const Topology& t, HalfEdge h, int quarters) {
  for (; quarters > 0; --quarters) h = t.ccw(h);
  for (; quarters < 0; ++quarters) h = t.next(t.twin(h));
  return h;
}

/// Returns the half-edge of the same face `count` corners further.
inline HalfEdge along(const Topology& t, HalfEdge h, int count) {
  for (; count > 0; --count) h = t.next(h);
  return h;
}

}  // namespace sublimit::testing
