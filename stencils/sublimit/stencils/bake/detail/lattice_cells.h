// SPDX-License-Identifier: Apache-2.0
#pragma once
// The face of a refined mesh for each cell of the lattices of a table by patterns.
#include <span>
#include <vector>

#include "sublimit/scheme/refine.h"

namespace sublimit {

/// Cells of the lattices on all faces of a level, in the order of `faces_of`, as faces of a later level.
/// @param levels  from the one that has the lattices to the one that has the cells; each step cuts faces into four of
///                their kind
/// @param triangles  faces are triangles, else quadrilaterals
/// @param turn    of each face of the first level: its corner that is the lattice's first one
/// @return  of each cell the half-edge of the last level that leaves its first corner: #faces x n^2, n = 2^steps
std::vector<HalfEdge> lattice_cells(std::span<const Level> levels, bool triangles, std::span<const std::int8_t> turn);

}  // namespace sublimit
