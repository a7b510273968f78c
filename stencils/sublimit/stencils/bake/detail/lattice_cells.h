// SPDX-License-Identifier: Apache-2.0
#pragma once
// The face of a refined mesh for each cell of the lattices of a table by patterns.
#include <span>
#include <vector>

#include "sublimit/scheme/refine.h"

namespace sublimit {

/// Returns the cells of the lattices on all faces of a level, in the order of `faces_of`, as faces of a later
/// level.
/// @param levels     levels from the one with the lattices to the one with the cells; each step cuts faces into
///                   four of their kind
/// @param triangles  true: faces are triangles; false: quadrilaterals
/// @param turn       for each face of the first level: the corner where its lattice starts
/// @return  for each cell the half-edge of the last level that leaves its first corner: #faces x n^2, n =
///          2^steps
std::vector<HalfEdge> lattice_cells(std::span<const Level> levels, bool triangles, std::span<const std::int8_t> turn);

}  // namespace sublimit
