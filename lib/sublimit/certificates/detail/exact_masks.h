// SPDX-License-Identifier: Apache-2.0
#pragma once
// Limit masks as exact numbers, where the field of the masks has them: the position always, tangents where the
// subdominant eigenvalue lies in it (Loop's 3/8 + 1/4 cos(2 pi/n); not Catmull-Clark's, which has a square root).
#include <optional>
#include <vector>

#include "sublimit/certificates/algebraic.h"
#include "sublimit/certificates/detail/exact_schemes.h"

namespace sublimit {

/// Masks by position in the slots of a patch (`patch.labels` says where they lie).
struct ExactMasks {
  std::vector<Algebraic> position;
  std::optional<std::vector<Algebraic>> tangent1, tangent2;  ///< of closed centres; scaled as those of `isolated_limit`
};

/// @param lambda  a real number that may be an eigenvalue of block 1; tangents are left out if it is no simple one
/// @throws AnalysisError  eigenvalue 1 is not simple
ExactMasks exact_masks(const LocalPatch<Algebraic>& patch, const std::optional<Algebraic>& lambda = std::nullopt);

}  // namespace sublimit
