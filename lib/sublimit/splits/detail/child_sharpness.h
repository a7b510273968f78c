// SPDX-License-Identifier: Apache-2.0
#pragma once
// Sharpness of the next level.
#include <utility>

#include "sublimit/mesh/sharpness.h"
#include "sublimit/splits/split.h"

namespace sublimit {

/// Returns the sharpness of the two halves, at its tail and at its head, of an edge that a primal split cuts.
std::pair<float, float> sharpness_of_halves(const Sharpness& sharpness, const Topology& parent, Edge e);

/// Returns the sharpness of the edges and vertices of a child. For splits that are not primal, only borders are
/// sharp.
[[nodiscard]] Sharpness refine(const Sharpness& sharpness, const Topology& parent, const Refinement& refinement);

}  // namespace sublimit
