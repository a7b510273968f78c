// SPDX-License-Identifier: Apache-2.0
#pragma once
// A limit surface with its points, cut into cells that are almost flat, each in boxes that hold it: what
// searches in space need.
#include <vector>

#include "sublimit/limit/detail/hull_cell.h"
#include "sublimit/limit/limit_map.h"

namespace sublimit {

/// Cells of all of the surface but its holes, in the order of addresses.
/// Polynomial pieces are cut until they are thin, and boxes hold their Bernstein coefficients; near extraordinary
/// vertices pieces are cut into children, and boxes hold all points that these depend on. Where no piece is a
/// polynomial that would be much too wide: there boxes hold a net of limit points, widened by a quarter.
/// @param points  of the level, #V x 3
/// @throws InvalidParameter  points that do not fit
std::vector<LimitCell> limit_cells(const LimitMap& surface, const Points& points);

}  // namespace sublimit
