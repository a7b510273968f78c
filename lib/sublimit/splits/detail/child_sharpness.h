// SPDX-License-Identifier: Apache-2.0
#pragma once
// Sharpness one level on.
#include <utility>

#include "sublimit/mesh/sharpness.h"
#include "sublimit/splits/split.h"

namespace sublimit {

/// Sharpness of the two halves, at its tail and at its head, of an edge that a primal split cuts.
std::pair<float, float> sharpness_of_halves(const Sharpness& sharpness, const Topology& parent, Edge e);

/// Sharpness of the child's edges and vertices; of other splits than primal ones only borders are sharp.
[[nodiscard]] Sharpness refine(const Sharpness& sharpness, const Topology& parent, const Refinement& refinement);

}  // namespace sublimit
