// SPDX-License-Identifier: Apache-2.0
// One side of a border, a crease or a corner. Where the border curve is refined by itself the local matrix is block
// triangular: modes of the curve (the tangent along it) and modes of the interior, which vanish on the curve.
#include <algorithm>

#include "sublimit/certificates/spectral_verdicts.h"

namespace sublimit {
namespace {

using By = Hypothesis::By;
using Answer = Verdict::Answer;

/// Eigenvalues of the rows and columns whose points are (or are not) on the curve, each as often as its multiplicity,
/// by modulus. The curve is its own mirror image, so each block falls apart like the whole.
std::vector<AlgebraicRoot> roots_of(const ExactBlocks& blocks, const std::vector<Index>& curve, bool on_curve) {
  std::vector<AlgebraicRoot> all;
  for (size_t k = 0; k < blocks.blocks.size(); ++k) {
    std::vector<Index> rows;
    for (size_t i = 0; i < blocks.orbits[k].size(); ++i)
      if (std::binary_search(curve.begin(), curve.end(), blocks.orbits[k][i][0]) == on_curve)
        rows.push_back(static_cast<Index>(i));
    const DenseMatrix<Algebraic> part = blocks.blocks[k](rows, rows);
    for (const ExactEigenvalue& value : exact_eigenvalues(part)) all.insert(all.end(), value.multiplicity, value.value);
  }
  std::stable_sort(all.begin(), all.end(),
                   [](const AlgebraicRoot& a, const AlgebraicRoot& b) { return compare_moduli(a, b) > 0; });
  return all;
}

bool is_positive(const AlgebraicRoot& root) { return root.is_real() && compare(root, AlgebraicRoot(Algebraic(0))) > 0; }

}  // namespace

Verdict tangent_plane(const ExactAnalysis& analysis) {
  const bool corner = analysis.patch.type.corner;
  Verdict v{"tangent-plane", corner ? "one tangent plane at the corner" : "one tangent plane at the border point"};
  v.theorem =
      "for generic data, by the order of modes: modes of the interior vanish on the border curve, so normals there "
      "are spanned by the tangent along it and the first mode of the interior, normals inside by the two modes "
      "that lead (an argument, not a published theorem)";
  const DenseMatrix<Algebraic>& A = analysis.patch.A;
  std::vector<Index> curve = analysis.patch.outline, inside;
  std::sort(curve.begin(), curve.end());
  for (Index i = 0; i < A.rows(); ++i)
    if (!std::binary_search(curve.begin(), curve.end(), i)) inside.push_back(i);
  Hypothesis apart{"the border curve does not depend on the interior", !curve.empty(), By::exact};
  for (const Index i : curve)
    for (const Index j : inside) apart.holds = *apart.holds && A(i, j).is_zero();
  v.hypotheses.push_back(apart);
  const std::vector<ExactEigenvalue> first = analysis.spectrum.of_rank(0);
  v.hypotheses.push_back(
      {"eigenvalue 1 is simple and larger than all others in modulus",
       first.size() == 1 && first[0].multiplicity == 1 && first[0].value == AlgebraicRoot(Algebraic(1)), By::exact,
       first.empty() ? "" : first[0].value.text()});
  if (!*apart.holds || !*v.hypotheses.back().holds) {
    v.because = "the argument does not speak of this: " + v.hypotheses[*apart.holds ? 1 : 0].says + " does not hold";
    return v;
  }
  const ExactBlocks& blocks = analysis.spectrum.blocks;
  const std::vector<AlgebraicRoot> along = roots_of(blocks, curve, true), across = roots_of(blocks, curve, false);
  const size_t tangents = corner ? 2 : 1;
  const bool has_tangents = along.size() > tangents && is_positive(along[1]) && along[tangents] == along[1] &&
                            (along.size() == tangents + 1 || compare_moduli(along[tangents + 1], along[1]) < 0);
  const AlgebraicRoot t = along.size() > 1 ? along[1] : AlgebraicRoot();
  v.hypotheses.push_back({corner ? "the two curves at the corner have tangents" : "the border curve has a tangent",
                          has_tangents, By::exact, t.text()});
  if (!has_tangents || across.empty()) {
    v.because = "the modes of the border curve are not those of a smooth curve";
    return v;
  }
  // The first mode of the interior that must not lead: at a corner the first, else the second.
  const size_t at = corner ? 0 : 1;
  const AlgebraicRoot rival = at < across.size() ? across[at] : AlgebraicRoot(Algebraic(0));
  const int order = compare_moduli(rival, t);
  const std::string name = corner ? "the first mode of the interior" : "the second mode of the interior";
  v.hypotheses.push_back({name + " is smaller than the tangent's", order < 0, order == 0 ? By::exact : By::enclosure,
                          rival.text() + " against " + t.text()});
  int longest = 1;  // Jordan block of the tangent's eigenvalue, even or odd
  for (const ExactEigenvalue& value : analysis.spectrum.values)
    if (value.value == t) longest = std::max(longest, value.largest_jordan());
  const bool defective = longest > 1;
  if (order > 0) {
    v.answer = Answer::disproved;
    v.because =
        name + " is larger than the tangent's: normals inside and normals on the border tend to different limits";
  } else if (order == 0 && defective) {
    v.answer = Answer::borderline;
    v.because = name + " equals the tangent's in one Jordan block of size " + std::to_string(longest) +
                ": the plane is reached, but like 1/steps";
  } else if (order == 0) {
    v.answer = Answer::disproved;
    v.because = name + " equals the tangent's, with eigenvectors of its own: three directions lead together";
  } else if (!corner && compare_moduli(across[0], t) == 0 && defective) {
    v.answer = Answer::borderline;
    v.because = "the first mode of the interior and the tangent share a Jordan block of size " +
                std::to_string(longest) + ": the plane is reached, but like 1/steps";
  } else if (!corner && !is_positive(across[0])) {
    v.because = "the first mode of the interior is not positive: " + across[0].text();
  } else if (!corner && along.size() > 2 && compare_moduli(along[2], across[0]) > 0) {
    v.because = "the second mode of the border curve leads before the first of the interior";
  } else {
    v.answer = Answer::evidence_for;
    v.hypotheses.push_back({"the map of the two leading modes is regular and injective", std::nullopt, By::exact});
    v.because = corner ? "the tangents of the two curves lead"
                       : "the tangent along the curve and the first mode of the interior lead";
  }
  return v;
}

}  // namespace sublimit
