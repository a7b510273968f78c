// SPDX-License-Identifier: Apache-2.0
#pragma once
// Centres: the places of a level at which limits are computed, and their places on the next level. In primal
// schemes a vertex stays a vertex. In dual schemes a vertex becomes a face with the same limit, and a face
// stays a face; a border vertex becomes the middle of a border edge.
#include "sublimit/scheme/scheme.h"

namespace sublimit {

/// A vertex, or the middle of a face or edge.
struct Centre {
  enum class Kind {
    vertex,  ///< tail of `start`
    face,    ///< face of `start`
    border,  ///< middle of `start`, which has no twin
    edge,    ///< middle of an interior edge `start`: child of a vertex of two faces, for which dual splits have no face
  };
  Kind kind = Kind::vertex;
  /// Any half-edge of the centre; for a border vertex the first one of its fan. After a whole period of the
  /// scheme the start of the child corresponds to that of its parent.
  HalfEdge start = no_half_edge;
};

/// Returns the place of a centre on the next level.
/// @param level  number of the parent level
Centre child(const Centre& centre, const Topology& parent, const Refinement& refinement, int level);

}  // namespace sublimit
