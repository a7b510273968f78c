// SPDX-License-Identifier: Apache-2.0
#pragma once
// Mirror symmetry of neighbourhoods: fans at a border, a crease or a corner (the first and the last spoke are
// exchanged) and darts (the sharp edge is fixed). A local matrix that commutes with the mirror decomposes into
// two blocks: of even modes, equal at mirror images, and of odd modes, opposite there.
#include <optional>
#include <vector>

#include "sublimit/certificates/spectra/fourier_blocks.h"

namespace sublimit {

/// Returns the mirror image of a label among n sectors.
/// @param closed  true if the last spoke is the first one
SectorLabel mirrored(const SectorLabel& label, int n, bool closed);

/// Returns the position of the mirror image of each point; nothing if a point has none, or the matrix does not
/// commute with the mirror (checked for every entry).
std::optional<std::vector<Index>> mirror_images(const LocalPatch<Algebraic>& patch);

/// Returns the even block, over pairs of mirror images and fixed points, and the odd block, over pairs: B(i, j)
/// = A(i, j) +- A(i, image of j). An eigenvector x of a block is one of A with the values x_i and +-x_i on pair
/// i.
/// @param images  result of `mirror_images`
ExactBlocks mirror_blocks(const DenseMatrix<Algebraic>& A, const std::vector<Index>& images);

}  // namespace sublimit
