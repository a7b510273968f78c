// SPDX-License-Identifier: Apache-2.0
#pragma once
// Mirror symmetry of neighbourhoods: fans at a border, a crease or a corner (the first and the last spoke are
// exchanged) and darts (the sharp edge is fixed). A local matrix that commutes with the mirror decomposes into
// two blocks: of even modes, equal at mirror images, and of odd modes, opposite there.
#include <optional>

#include "sublimit/certificates/spectra/fourier_blocks.h"

namespace sublimit {

/// Returns the mirror image of a label among n sectors.
/// @param closed  true if the last spoke is the first one
SectorLabel mirrored(const SectorLabel& label, int n, bool closed);

/// Returns the rows of one half of a patch's matrix, over pairs of mirror images and points that are their own image;
/// nothing if a point has no image, or the matrix does not commute with the mirror (checked for every entry).
std::optional<ExactRows> mirror_rows(const LocalPatch<Algebraic>& patch);

}  // namespace sublimit
