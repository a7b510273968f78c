// SPDX-License-Identifier: Apache-2.0
#pragma once
// Sides of the vertices of a level, at which limits are computed: one for each fan of faces, or for each part
// of a fan that sharp edges separate.
#include <vector>

#include "sublimit/neighborhood/centre.h"
#include "sublimit/scheme/refine.h"

namespace sublimit {

/// All sides of a level.
struct VertexSides {
  std::vector<Centre> centres;     ///< one per side
  std::vector<Index> vertex;       ///< vertex of each side, ascending; isolated vertices have no side
  std::vector<Index> corner_side;  ///< side of each half-edge (corner of a face)
  std::vector<bool> hole;          ///< per side: true if all its faces are holes
};

/// Returns the sides of all vertices.
VertexSides vertex_sides(const Level& level);

/// Returns the first side of a corner's fan, with the start that it has in `vertex_sides`.
Centre first_side(const Level& level, HalfEdge corner);

/// Returns the side of its tail that contains a half-edge's face, as in `vertex_sides` except for the start of
/// a closed one.
Centre side_of(const Level& level, HalfEdge corner);

/// Returns for each vertex whether it is in no face, or in holes only.
/// @param holes  per face
std::vector<bool> vertices_without_surface(const Topology& topology, const std::vector<bool>& holes);

}  // namespace sublimit
