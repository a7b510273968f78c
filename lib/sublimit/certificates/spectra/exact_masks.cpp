// SPDX-License-Identifier: Apache-2.0
#include "sublimit/certificates/spectra/exact_masks.h"

#include "sublimit/certificates/numbers/detail/exact_kernel.h"
#include "sublimit/certificates/spectra/fourier_blocks.h"

namespace sublimit {
namespace {

/// The eigenvector of an eigenvalue of the field, if it has one up to a factor.
std::optional<ExactRows::Vector> eigenvector(const DenseMatrix<Algebraic>& B, const Algebraic& value) {
  const ExactKernel kernel = exact_eigenvectors(B, AlgebraicRoot(value));
  if (kernel.vectors.size() != 1) return std::nullopt;
  ExactRows::Vector x(B.rows());
  for (Eigen::Index i = 0; i < x.size(); ++i) x[i] = kernel.vectors[0][size_t(i)].at(value);
  return x;
}

}  // namespace

ExactMasks exact_masks(const LocalPatch<Algebraic>& patch, const std::optional<Algebraic>& lambda) {
  const ExactBlocks fourier = exact_blocks(patch);
  ExactMasks masks;
  const auto left = eigenvector(fourier.blocks[0].transpose(), 1);
  if (!left) throw AnalysisError("a local matrix has no limit: eigenvalue 1 is not simple");
  const ExactRows::Vector position = fourier.rows.mask(0, *left / left->sum());
  masks.position.assign(position.begin(), position.end());

  if (!lambda || fourier.sectors < 3) return masks;
  const DenseMatrix<Algebraic>& B = fourier.blocks[1];
  const auto l = eigenvector(B.transpose(), *lambda), r = eigenvector(B, *lambda);
  if (!l || !r) return masks;
  const Algebraic overlap = l->cwiseProduct(*r).sum(), &unit = (*r)[0];
  if (overlap.is_zero() || unit.is_zero()) return masks;
  // The end of the first edge lies at 1 in the characteristic map.
  const ExactRows::Vector mask = fourier.rows.mask(1, *l * (unit / overlap));
  const Algebraic i_unit = Algebraic::root_of_unity(1, 4);
  masks.tangent1.emplace();
  masks.tangent2.emplace();
  for (const Algebraic& w : mask) {
    masks.tangent1->push_back(w + w.conj());
    masks.tangent2->push_back((w - w.conj()) * i_unit);
  }
  return masks;
}

}  // namespace sublimit
