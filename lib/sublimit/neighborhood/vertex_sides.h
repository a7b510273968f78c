// SPDX-License-Identifier: Apache-2.0
#pragma once
// The sides of the vertices of a level as places where limits are taken: a side for each fan of faces, and for each
// part of a fan that sharp edges cut off.
#include <vector>

#include "sublimit/neighborhood/centre.h"
#include "sublimit/scheme/refine.h"

namespace sublimit {

struct VertexSides {
  std::vector<Centre> centres;     ///< one per side
  std::vector<Index> vertex;       ///< of each side; ascending; isolated vertices have none
  std::vector<Index> corner_side;  ///< side of each half-edge (corner of a face)
  std::vector<bool> hole;          ///< all faces of the side are holes
};

VertexSides vertex_sides(const Level& level);

/// The side of its tail that a half-edge's face is on: such a centre as `vertex_sides` has, but for where a closed one
/// starts.
Centre side_of(const Level& level, HalfEdge corner);

/// Returns for each vertex whether it is in no face, or in holes only.
/// @param holes  per face
std::vector<bool> vertices_without_surface(const Topology& topology, const std::vector<bool>& holes);

}  // namespace sublimit
