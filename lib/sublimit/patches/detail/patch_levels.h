// SPDX-License-Identifier: Apache-2.0
#pragma once
// Sizes of refined control nets, checked before their memory is allocated.
#include "sublimit/patches/patch_set.h"

namespace sublimit {

/// Size of a level: a lower bound on its control points, and an estimate of the nonzeros of the S that makes it.
struct PatchLevelSize {
  double points = 0, nonzeros = 0;
};
/// Returns the size of a level of patches.
PatchLevelSize level_size(const PatchSet& patches, int level);

/// Throws unless there is memory for `levels` levels; for callers that make them one by one with `refined`.
/// @param product  true if the product of all S is kept too
/// @throws InvalidParameter  negative `levels`
/// @throws ResourceError     more memory than there is, or more numbers than 32-bit indices count; names the
///                           number of levels that fit
void check_levels(const PatchSet& patches, int levels, bool product = false);

}  // namespace sublimit
