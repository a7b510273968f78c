// SPDX-License-Identifier: Apache-2.0
#pragma once
// Sharpness one level on.
#include "sublimit/mesh/sharpness.h"
#include "sublimit/splits/split.h"

namespace sublimit {

/// Sharpness of the child's edges and vertices; of other splits than primal ones only borders are sharp.
Sharpness refine(const Sharpness& sharpness, const Topology& parent, const Refinement& refinement);

}  // namespace sublimit
