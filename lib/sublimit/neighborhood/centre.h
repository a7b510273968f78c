// SPDX-License-Identifier: Apache-2.0
#pragma once
// Where a limit is taken, and where that place is one level on. In primal schemes a vertex stays a vertex. In dual ones
// it becomes a face, whose limit is the limit of the vertex, and a face stays a face; on the border the place is the
// middle of a border edge.
#include "sublimit/scheme/scheme.h"

namespace sublimit {

struct Centre {
  enum class Kind {
    vertex,  ///< tail of `start`
    face,    ///< face of `start`
    border,  ///< middle of `start`, which has no twin
    edge,    ///< middle of `start`, which has one: a vertex of two faces, of which dual splits make no face
  };
  Kind kind = Kind::vertex;
  /// A closed place can start anywhere; an open vertex starts with the first half-edge of its fan. Children lie as
  /// their parents do, after a whole period of the scheme.
  HalfEdge start = no_half_edge;
};

/// @param level  of the parent
Centre child(const Centre& centre, const Topology& parent, const Refinement& refinement, int level);

}  // namespace sublimit
