// SPDX-License-Identifier: Apache-2.0
#pragma once
// Where lattices on faces lie in the addresses (face, u, v) of a control mesh.
#include <optional>
#include <span>
#include <vector>

#include "sublimit/face_lattices.h"
#include "sublimit/scheme/refine.h"

namespace sublimit {

/// Of faces of level 1: quarters of quadrilaterals, and of other polygons all of the square at a corner.
/// @param turn  of each face: its corner that is the lattice's first one
/// @return      nothing where they are something else
std::optional<std::vector<LatticePlace>> places_of_children(const Scheme<double>& scheme, const Level& control,
                                                            const Level& level, std::span<const std::int8_t> turn);

}  // namespace sublimit
