// SPDX-License-Identifier: Apache-2.0
#pragma once
// A place on a limit surface, followed through the children of the face that it lies in. Addresses are binary numbers,
// and 256 bits hold every place on the way exactly. Topology only: indices of the splits, no masks.
#include <span>

#include "sublimit/source/address.h"
#include "sublimit/splits/split.h"
#include "support/precise.h"

namespace sublimit::testing {

/// A square or triangle of some level that contains the place, and the place in it.
struct DescentPlace {
  enum class Cell {
    square,         ///< a quad; `frame` starts at (0,0) and runs to (1,0)
    corner,         ///< one corner of a polygon, as control addresses have it: `frame` starts there
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

/// Where an address is.
/// @throws InvalidParameter  no such address, or a place outside it
DescentPlace place_of(const Topology& control, bool triangles, const Place& place);

/// One refinement with the topology that it refined.
struct TakenStep {
  const Topology* parent = nullptr;
  const Refinement* refinement = nullptr;
};

/// The place in the mesh after these steps: all those of a level, of two levels of the rotating schemes (sqrt3,
/// mid-edge).
/// @throws UnsupportedTopology  faces cut by Split::quads, where addresses have no natural meaning
DescentPlace descend(const DescentPlace& place, std::span<const TakenStep> steps);

/// Half-edges of a vertex with four faces around it, counter-clockwise.
inline HalfEdge turned(const Topology& t, HalfEdge h, int quarters) {
  for (; quarters > 0; --quarters) h = t.ccw(h);
  for (; quarters < 0; ++quarters) h = t.next(t.twin(h));
  return h;
}

/// Half-edge of the same face, `count` corners on.
inline HalfEdge along(const Topology& t, HalfEdge h, int count) {
  for (; count > 0; --count) h = t.next(h);
  return h;
}

}  // namespace sublimit::testing
