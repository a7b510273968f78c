// SPDX-License-Identifier: Apache-2.0
#pragma once
// Limit masks as exact numbers, where the field of the masks has them: the position always, tangents where the
// subdominant eigenvalue lies in it (Loop's 3/8 + 1/4 cos(2 pi/n); not Catmull-Clark's, which has a square root).
#include <optional>
#include <vector>

#include "sublimit/analysis/local_patch.h"
#include "sublimit/certificates/algebraic.h"

namespace sublimit {

/// Masks by position in the slots of the smallest closed set (`patch.labels` says where they lie).
struct ExactMasks {
  std::vector<Algebraic> position;
  std::optional<std::vector<Algebraic>> tangent1, tangent2;  ///< scaled as those of `lone_limit`
};

/// Of a patch that has orbits (a closed centre) or, the position alone, of an open one.
/// @param lambda  a number that may be an eigenvalue of block 1 and is real; tangents are left out if it is none
/// @throws AnalysisError  eigenvalue 1 is not simple
ExactMasks exact_masks(const LocalPatch<Algebraic>& patch, const std::optional<Algebraic>& lambda = std::nullopt);

/// Fourier block k of a patch with orbits: acts on amplitudes x_i w^(k s), w = exp(2 pi i/n); centres, in block 0
/// alone, come first.
DenseMatrix<Algebraic> exact_block(const LocalPatch<Algebraic>& patch, int k);

/// Basis of the vectors x with M x = 0, by elimination.
std::vector<std::vector<Algebraic>> null_space(DenseMatrix<Algebraic> M);

}  // namespace sublimit
