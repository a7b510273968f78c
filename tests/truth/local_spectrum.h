// SPDX-License-Identifier: Apache-2.0
#pragma once
// Spectra of local matrices in 256-bit floats, Fourier block by Fourier block: multiplicities and Jordan blocks are
// rank decisions with sixty digits to spare, so closed forms are compared as they are written.
#include <complex>
#include <string>
#include <vector>

#include "sublimit/neighborhood/local_patch.h"
#include "sublimit/schemes/schemes.h"
#include "truth/precise_schemes.h"

namespace sublimit::testing {

class LocalSpectrum {
 public:
  /// Computes the spectrum around a vertex of valence n, or a face of n corners if the scheme is dual, over one
  /// period.
  /// @param rings  least number of rings of points, as for local_patch; -1: as many as tangents need
  LocalSpectrum(const Scheme<Precise>& scheme, int n, int rings = -1);
  LocalSpectrum(const std::string& name, int n, int rings = -1, const SchemeOptions& options = {});

  int n() const { return n_; }
  /// Returns the number of rows of block k.
  int size(int k) const { return static_cast<int>(blocks_[wrapped(k)].rows() / 2); }
  /// Returns the dimensions of the null spaces of (B_k - lambda)^j, j = 1, 2, ... while they grow: {} means not
  /// an eigenvalue, {2} a double one with two eigenvectors, {1, 2, 3} a Jordan block of size 3.
  std::vector<int> staircase(int k, const Precise& lambda) const;
  int multiplicity(int k, const Precise& lambda) const;
  /// Returns the sums of the j-th powers of the eigenvalues of block k, j = 1 ... size(k). They determine the
  /// eigenvalues, and are well-conditioned even if these cluster.
  std::vector<std::complex<double>> power_sums(int k) const;
  /// Returns the moduli of the eigenvalues of block k, descending.
  std::vector<double> moduli(int k) const;
  /// Returns the largest modulus of all blocks that is below `modulus`.
  double largest_below(double modulus) const;
  /// Returns the largest modulus of block k that is below 1.
  double leading(int k) const;

 private:
  int wrapped(int k) const { return (k % n_ + n_) % n_; }
  int n_ = 0;
  std::vector<DenseMatrix<Precise>> blocks_;  // complex B as real [[Re, -Im], [Im, Re]]: every dimension is doubled
};

/// Returns numbers in closed forms: cos(2 pi k/n), ...
inline Precise cosine(int k, int n) { return Number<Precise>::cos_2pi(k, n); }
inline Precise sine(int k, int n) { return Number<Precise>::cos_2pi(4 * k - n, 4 * n); }
inline Precise ratio(int p, int q) { return Number<Precise>::ratio(p, q); }

}  // namespace sublimit::testing
