// SPDX-License-Identifier: Apache-2.0
#pragma once
// Limit surfaces cut into almost flat cells with bounding boxes, for searches in space.
#include <vector>

#include "sublimit/nets/hull_cell.h"
#include "sublimit/surface/limit_map.h"

namespace sublimit {

/// Returns the cells of the surface without its holes, by ascending address.
///
/// Polynomial pieces are subdivided until they are thin; their boxes contain the Bernstein coefficients. Other
/// pieces, near extraordinary vertices, are cut into children; their boxes contain all points that these depend
/// on, widened by `PieceType::reach`. If no piece of the scheme is a polynomial, such boxes would be much too
/// large: they contain a grid of limit points instead, widened by a quarter, which is no proven bound.
/// @param points  points of the surface's level, #V x 3
/// @throws InvalidParameter  points of another shape
std::vector<LimitCell> limit_cells(const LimitMap& surface, const Points& points);

}  // namespace sublimit
