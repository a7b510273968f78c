// SPDX-License-Identifier: Apache-2.0
#pragma once
// Fourier blocks of local matrices, exactly. A matrix that commutes with the rotation of a closed neighbourhood by one
// sector falls into blocks B_k(i, j) = sum_t A(orbit_i[0], orbit_j[t]) w^(k t), w = exp(2 pi i/n): an eigenvector x of
// B_k is one of A with the value x_i w^(k s) on sector s of orbit i.
#include <vector>

#include "sublimit/certificates/algebraic.h"
#include "sublimit/certificates/detail/exact_schemes.h"

namespace sublimit {

struct ExactBlocks {
  int sectors = 0;  ///< n; 0 for an open neighbourhood: two blocks by its mirror (mirror.h), or one
  /// Block k = 0 ... n/2; block n - k is the conjugate of block k. Row i belongs to `orbits[k][i]`.
  std::vector<DenseMatrix<Algebraic>> blocks = {};
  /// Per block and row, the positions in the patch, sector by sector; the centre, one position, is in block 0 alone.
  std::vector<std::vector<std::vector<Index>>> orbits = {};
};

/// @throws AnalysisError  the matrix of a closed one does not commute with the rotation (checked for every entry), or
/// is not real
ExactBlocks exact_blocks(const LocalPatch<Algebraic>& patch);

/// Row i of a matrix depends on row j, and j on i: sets of rows of the diagonal blocks of its block triangular form.
std::vector<std::vector<Index>> strong_components(const DenseMatrix<Algebraic>& A);

}  // namespace sublimit
