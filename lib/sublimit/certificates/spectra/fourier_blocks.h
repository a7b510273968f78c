// SPDX-License-Identifier: Apache-2.0
#pragma once
// Exact Fourier blocks of local matrices: those of the rotation of a closed neighbourhood by one sector, or of the
// mirror of an open one (mirror.h).
#include <functional>
#include <optional>
#include <vector>

#include "sublimit/certificates/numbers/algebraic.h"
#include "sublimit/certificates/spectra/exact_schemes.h"
#include "sublimit/core/detail/sector_rows.h"

namespace sublimit {

using ExactRows = SectorRowsOf<Algebraic, Algebraic>;

/// Returns the rows of one sector of an exact matrix (sector_rows.h); nothing unless it commutes with the symmetry.
/// @param unequal  is called with the first two weights that should be equal and are not
std::optional<ExactRows> exact_rows(
    const DenseMatrix<Algebraic>& A, Orbits orbits,
    const std::function<void(const Algebraic&, const Algebraic&)>& unequal = [](const auto&, const auto&) {});

/// Blocks of a local matrix.
struct ExactBlocks {
  int sectors = 0;  ///< n; 0 for an open neighbourhood, which has two blocks by mirror symmetry, or one
  ExactRows rows = {};
  /// Block k = 0 ... n/2; block n - k is the conjugate of block k. Row i belongs to `orbits[k][i]`.
  std::vector<DenseMatrix<Algebraic>> blocks = {};
  /// Per block and row: the positions in the patch, sector by sector. The centre, a single position, is only in
  /// block 0.
  std::vector<Orbits> orbits = {};
};

/// Returns the blocks of a local matrix.
/// @throws AnalysisError  the matrix of a closed neighbourhood does not commute with the rotation (checked for
///                        every entry), or is not real
ExactBlocks exact_blocks(const LocalPatch<Algebraic>& patch);

}  // namespace sublimit
