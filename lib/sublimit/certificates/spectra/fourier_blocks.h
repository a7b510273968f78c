// SPDX-License-Identifier: Apache-2.0
#pragma once
// Exact Fourier blocks of local matrices. A matrix that commutes with the rotation of a closed neighbourhood by
// one sector decomposes into blocks B_k(i, j) = sum_t A(orbit_i[0], orbit_j[t]) w^(k t), w = exp(2 pi i/n): an
// eigenvector x of B_k is one of A with the value x_i w^(k s) on sector s of orbit i.
#include <vector>

#include "sublimit/certificates/numbers/algebraic.h"
#include "sublimit/certificates/spectra/exact_schemes.h"

namespace sublimit {

/// Blocks of a local matrix.
struct ExactBlocks {
  int sectors = 0;  ///< n; 0 for an open neighbourhood, which has two blocks by mirror symmetry (mirror.h), or one
  /// Block k = 0 ... n/2; block n - k is the conjugate of block k. Row i belongs to `orbits[k][i]`.
  std::vector<DenseMatrix<Algebraic>> blocks = {};
  /// Per block and row: the positions in the patch, sector by sector. The centre, a single position, is only in
  /// block 0.
  std::vector<std::vector<std::vector<Index>>> orbits = {};
};

/// Returns the blocks of a local matrix.
/// @throws AnalysisError  the matrix of a closed neighbourhood does not commute with the rotation (checked for
///                        every entry), or is not real
ExactBlocks exact_blocks(const LocalPatch<Algebraic>& patch);

/// Returns the strongly connected components of the rows of a matrix: the diagonal blocks of its block
/// triangular form.
std::vector<std::vector<Index>> strong_components(const DenseMatrix<Algebraic>& A);

}  // namespace sublimit
