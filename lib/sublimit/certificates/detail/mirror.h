// SPDX-License-Identifier: Apache-2.0
#pragma once
// Neighbourhoods that look the same in a mirror: fans of a border, a crease or a corner (first spoke and last change
// places) and darts (their sharp edge stays). Modes are even, equal at mirror images, or odd, opposite there; so a
// local matrix that commutes with the mirror falls into two blocks.
#include <optional>
#include <vector>

#include "sublimit/certificates/detail/fourier_blocks.h"

namespace sublimit {

/// The mirror image of a label of n sectors.
/// @param closed  the last spoke is the first one
SectorLabel mirrored(const SectorLabel& label, int n, bool closed);

/// Positions of mirror images; nothing where a point has none, or the matrix does not commute with the mirror (checked
/// for every entry).
std::optional<std::vector<Index>> mirror_images(const LocalPatch<Algebraic>& patch);

/// The even block, over pairs of mirror images and points that are their own, then the odd block, over pairs:
/// B(i, j) = A(i, j) +- A(i, image of j). An eigenvector x of it is one of A with the values x_i and +-x_i on pair i.
/// @param images  as above
ExactBlocks mirror_blocks(const DenseMatrix<Algebraic>& A, const std::vector<Index>& images);

}  // namespace sublimit
