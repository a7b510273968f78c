// SPDX-License-Identifier: Apache-2.0
#include "sublimit/certificates/spectra/exact_spectrum.h"

#include <algorithm>

#include "sublimit/certificates/numbers/detail/exact_kernel.h"

namespace sublimit {
namespace {

/// Eigenvalues of one block with algebraic multiplicities: those of the diagonal blocks of its triangular form.
std::vector<ExactEigenvalue> block_values(const DenseMatrix<Algebraic>& B) {
  std::vector<ExactEigenvalue> values;
  std::vector<std::vector<Index>> columns(size_t(B.rows()));
  for (Index i = 0; i < B.rows(); ++i)
    for (Index j = 0; j < B.cols(); ++j)
      if (!B(i, j).is_zero()) columns[size_t(i)].push_back(j);
  for (const std::vector<Index>& component : strong_components(columns)) {
    const DenseMatrix<Algebraic> C = B(component, component);
    for (const PolynomialFactor& factor : squarefree_factors(characteristic_polynomial(C)))
      for (AlgebraicRoot& root : AlgebraicRoot::all(factor.factor)) {
        const auto same = std::find_if(values.begin(), values.end(),
                                       [&](const ExactEigenvalue& known) { return known.value == root; });
        if (same != values.end()) {
          same->multiplicity += factor.multiplicity;
          if (!same->value.exact() && root.polynomial().degree() < same->value.polynomial().degree())
            same->value = std::move(root);
        } else {
          ExactEigenvalue value;
          value.value = std::move(root);
          value.multiplicity = factor.multiplicity;
          values.push_back(std::move(value));
        }
      }
  }
  for (ExactEigenvalue& value : values) value.jordan = jordan_sizes(B, value.value, value.multiplicity);
  return values;
}

/// Sorts by modulus.
void rank(std::vector<ExactEigenvalue>& all) {
  std::stable_sort(all.begin(), all.end(), [](const ExactEigenvalue& a, const ExactEigenvalue& b) {
    return compare_moduli(a.value, b.value) > 0;
  });
  for (size_t i = 1; i < all.size(); ++i)
    all[i].rank = all[i - 1].rank + (compare_moduli(all[i - 1].value, all[i].value) != 0);
}

}  // namespace

std::vector<ExactEigenvalue> ExactSpectrum::of_rank(int rank) const {
  std::vector<ExactEigenvalue> some;
  std::copy_if(values.begin(), values.end(), std::back_inserter(some),
               [&](const ExactEigenvalue& value) { return value.rank == rank; });
  return some;
}

ExactSpectrum exact_spectrum(const LocalPatch<Algebraic>& patch) { return exact_spectrum(exact_blocks(patch)); }

ExactSpectrum exact_spectrum(ExactBlocks blocks) {
  ExactSpectrum spectrum;
  spectrum.blocks = std::move(blocks);
  const int n = spectrum.blocks.sectors;
  const bool one = spectrum.blocks.blocks.size() == 1;
  for (int k = 0; k < static_cast<int>(spectrum.blocks.blocks.size()); ++k)
    for (ExactEigenvalue& value : block_values(spectrum.blocks.blocks[k])) {
      value.block = one ? -1 : k;
      value.copies = n > 0 && k > 0 && 2 * k < n ? 2 : 1;
      spectrum.values.push_back(std::move(value));
    }
  rank(spectrum.values);
  return spectrum;
}

std::vector<ExactEigenvalue> exact_eigenvalues(const DenseMatrix<Algebraic>& A) {
  std::vector<ExactEigenvalue> values = block_values(A);
  for (ExactEigenvalue& value : values) value.block = -1;
  rank(values);
  return values;
}

}  // namespace sublimit
