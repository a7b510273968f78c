// SPDX-License-Identifier: Apache-2.0
#pragma once
// Exact eigenvalues of local matrices, with multiplicities and Jordan blocks per Fourier block, and their exact
// order by modulus.
#include <optional>
#include <vector>

#include "sublimit/certificates/numbers/detail/algebraic_root.h"
#include "sublimit/certificates/spectra/fourier_blocks.h"

namespace sublimit {

/// One eigenvalue of one Fourier block.
struct ExactEigenvalue {
  AlgebraicRoot value = {};
  /// Fourier block k = 0 ... n/2 (block n - k has the conjugate). Mirror symmetry: 0 even, 1 odd. No symmetry:
  /// -1.
  int block = 0;
  int copies = 1;           ///< 2 if block n - k differs from block k; multiplicities below count in each of them
  int multiplicity = 1;     ///< algebraic multiplicity in the block
  std::vector<int> jordan;  ///< sizes of its Jordan blocks, descending
  int rank = 0;             ///< equal moduli have equal ranks; 0 is the largest modulus
  int geometric() const { return static_cast<int>(jordan.size()); }
  int largest_jordan() const { return jordan.empty() ? 0 : jordan[0]; }
};

/// All eigenvalues of a local matrix.
struct ExactSpectrum {
  ExactBlocks blocks = {};
  std::vector<ExactEigenvalue> values = {};  ///< by rank, then by block
  int num_ranks() const { return values.empty() ? 0 : values.back().rank + 1; }
  /// Returns all eigenvalues of one rank.
  std::vector<ExactEigenvalue> of_rank(int rank) const;
};

/// Returns the spectrum of a local matrix, or of given blocks.
ExactSpectrum exact_spectrum(const LocalPatch<Algebraic>& patch);
ExactSpectrum exact_spectrum(ExactBlocks blocks);
/// Returns the eigenvalues of a real matrix without symmetry, ranked by modulus.
std::vector<ExactEigenvalue> exact_eigenvalues(const DenseMatrix<Algebraic>& A);

}  // namespace sublimit
