// SPDX-License-Identifier: Apache-2.0
#pragma once
// Spectra of local matrices in 256-bit floats, Fourier block by Fourier block: multiplicities and Jordan blocks are
// rank decisions with sixty digits to spare, so closed forms are compared as they are written.
#include <complex>
#include <string>
#include <vector>

#include "sublimit/neighborhood/local_patch.h"
#include "sublimit/schemes/schemes.h"
#include "support/precise_schemes.h"

namespace sublimit::testing {

class LocalSpectrum {
 public:
  /// Around a vertex of valence n, or a face of n corners if the scheme is dual; over one period.
  /// @param rings  of points at least, as local_patch has them; -1 for as many as tangents need
  LocalSpectrum(const Scheme<Precise>& scheme, int n, int rings = -1);
  LocalSpectrum(const std::string& name, int n, int rings = -1, const SchemeOptions& options = {});

  int n() const { return n_; }
  /// Rows of block k.
  int size(int k) const { return static_cast<int>(blocks_[wrapped(k)].rows() / 2); }
  /// Dimensions of the null spaces of (B_k - lambda)^j, j = 1, 2 ... while they grow: {} is no eigenvalue, {2} a double
  /// one with two eigenvectors, {1, 2, 3} a Jordan block of size 3.
  std::vector<int> staircase(int k, const Precise& lambda) const;
  int multiplicity(int k, const Precise& lambda) const;
  /// Sums of the j-th powers of the eigenvalues of block k, j = 1 ... size(k): what the eigenvalues are, however they
  /// cluster.
  std::vector<std::complex<double>> power_sums(int k) const;
  /// Moduli of the eigenvalues of block k, descending.
  std::vector<double> moduli(int k) const;
  /// Largest modulus of all blocks below `modulus`.
  double largest_below(double modulus) const;
  /// Largest modulus of block k below 1.
  double leading(int k) const;

 private:
  int wrapped(int k) const { return (k % n_ + n_) % n_; }
  int n_ = 0;
  std::vector<DenseMatrix<Precise>> blocks_;  // complex B as real [[Re, -Im], [Im, Re]]: every dimension is doubled
};

/// Numbers of the closed forms.
inline Precise cosine(int k, int n) { return Number<Precise>::cos_2pi(k, n); }
inline Precise sine(int k, int n) { return Number<Precise>::cos_2pi(4 * k - n, 4 * n); }
inline Precise ratio(int p, int q) { return Number<Precise>::ratio(p, q); }

}  // namespace sublimit::testing
