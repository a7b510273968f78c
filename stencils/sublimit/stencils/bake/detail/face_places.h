// SPDX-License-Identifier: Apache-2.0
#pragma once
// The positions of lattices on faces in the addresses (face, u, v) of a control mesh.
#include <optional>
#include <span>
#include <vector>

#include "sublimit/eval/table/face_lattices.h"
#include "sublimit/scheme/refine.h"

namespace sublimit {

/// Returns the positions of the faces of level 1: quarters of quadrilaterals, and squares at the corners of other
/// polygons. Absent if the faces of level 1 are others.
/// @param turn  corner of each face where its lattice starts
std::optional<std::vector<LatticePlace>> places_of_children(const Scheme<double>& scheme, const Level& control,
                                                            const Level& level, std::span<const std::int8_t> turn);

}  // namespace sublimit
