// SPDX-License-Identifier: Apache-2.0
#pragma once
// Sizes of finer nets, checked before memory is taken for them.
#include "sublimit/patches/patch_set.h"

namespace sublimit {

/// Size of a level: a lower bound on its control points, and an estimate of the nonzeros of the S that makes it.
struct PatchLevelSize {
  double points = 0, nonzeros = 0;
};
PatchLevelSize level_size(const PatchSet& patches, int level);

/// For those who make levels one by one by `refined`.
/// @param product  whether the product of all S is kept besides
/// @throws InvalidParameter  negative `levels`
/// @throws ResourceError     more memory than there is, or more numbers than 32-bit indices count; says how many levels
///                           there is room for
void check_levels(const PatchSet& patches, int levels, bool product = false);

}  // namespace sublimit
