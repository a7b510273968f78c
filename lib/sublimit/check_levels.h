// SPDX-License-Identifier: Apache-2.0
#pragma once
// Sizes of levels, checked before memory is taken.
#include "sublimit/scheme.h"

namespace sublimit {

/// What `refine` checks before the first level is made; for those who make levels one by one.
/// @throws InvalidParameter  negative `levels`
/// @throws ResourceError     more elements than 32-bit indices, or more memory than the machine has
void check_levels(const Scheme<double>& scheme, const Topology& control, int levels);

}  // namespace sublimit
