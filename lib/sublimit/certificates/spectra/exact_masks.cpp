// SPDX-License-Identifier: Apache-2.0
#include "sublimit/certificates/spectra/exact_masks.h"

#include "sublimit/certificates/numbers/detail/exact_kernel.h"
#include "sublimit/certificates/spectra/fourier_blocks.h"

namespace sublimit {
namespace {

/// The eigenvector of an eigenvalue of the field, if it has one up to a factor.
std::optional<std::vector<Algebraic>> eigenvector(const DenseMatrix<Algebraic>& B, const Algebraic& value) {
  const ExactKernel kernel = exact_eigenvectors(B, AlgebraicRoot(value));
  if (kernel.vectors.size() != 1) return std::nullopt;
  std::vector<Algebraic> x;
  for (const Polynomial& p : kernel.vectors[0]) x.push_back(p.at(value));
  return x;
}

}  // namespace

ExactMasks exact_masks(const LocalPatch<Algebraic>& patch, const std::optional<Algebraic>& lambda) {
  const ExactBlocks fourier = exact_blocks(patch);
  ExactMasks masks;
  masks.position.assign(patch.slots.size(), Algebraic(0));
  const auto left = eigenvector(fourier.blocks[0].transpose(), 1);
  if (!left) throw AnalysisError("a local matrix has no limit: eigenvalue 1 is not simple");
  Algebraic sum = 0;
  for (const Algebraic& w : *left) sum += w;
  for (size_t i = 0; i < left->size(); ++i)
    for (const Index slot : fourier.orbits[0][i])
      masks.position[slot] = (*left)[i] / (sum * static_cast<long>(fourier.orbits[0][i].size()));

  const long n = fourier.sectors;
  if (!lambda || n < 3) return masks;
  const DenseMatrix<Algebraic>& B = fourier.blocks[1];
  const auto l = eigenvector(B.transpose(), *lambda), r = eigenvector(B, *lambda);
  if (!l || !r) return masks;
  Algebraic overlap = 0;
  for (size_t i = 0; i < l->size(); ++i) overlap += (*l)[i] * (*r)[i];
  if (overlap.is_zero() || (*r)[0].is_zero()) return masks;
  // The end of the first edge lies at 1 in the characteristic map.
  const Algebraic scale = (*r)[0] / overlap * Algebraic::ratio(1, n), i_unit = Algebraic::root_of_unity(1, 4);
  masks.tangent1.emplace(patch.slots.size(), Algebraic(0));
  masks.tangent2.emplace(patch.slots.size(), Algebraic(0));
  for (size_t i = 0; i < l->size(); ++i)
    for (long s = 0; s < n; ++s) {
      const Algebraic w = (*l)[i] * scale * Algebraic::root_of_unity(-s, n), c = w.conj();
      const Index slot = fourier.orbits[1][i][s];
      (*masks.tangent1)[slot] = w + c;
      (*masks.tangent2)[slot] = (w - c) * i_unit;
    }
  return masks;
}

}  // namespace sublimit
