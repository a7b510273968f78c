// SPDX-License-Identifier: Apache-2.0
#pragma once
// Limit masks as exact numbers of the field of the masks. The position always has one; tangents do if the
// subdominant eigenvalue lies in the field (Loop's 3/8 + 1/4 cos(2 pi/n) does; Catmull-Clark's, a square root,
// does not).
#include <optional>
#include <vector>

#include "sublimit/certificates/numbers/algebraic.h"
#include "sublimit/certificates/spectra/exact_schemes.h"

namespace sublimit {

/// Masks by position in the slots of a patch (see `patch.labels`).
struct ExactMasks {
  std::vector<Algebraic> position;
  std::optional<std::vector<Algebraic>> tangent1, tangent2;  ///< for closed centres; scaled as in `isolated_limit`
};

/// Returns the limit masks of a patch.
/// @param lambda  a real number; tangents are computed if it is a simple eigenvalue of block 1
/// @throws AnalysisError  eigenvalue 1 is not simple
ExactMasks exact_masks(const LocalPatch<Algebraic>& patch, const std::optional<Algebraic>& lambda = std::nullopt);

}  // namespace sublimit
