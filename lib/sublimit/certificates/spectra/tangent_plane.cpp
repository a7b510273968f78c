// SPDX-License-Identifier: Apache-2.0
// One side of a border, a crease or a corner. Where the border curve is refined by itself the local matrix is block
// triangular: modes of the curve (the tangent along it) and modes of the interior, which vanish on the curve.
#include <algorithm>

#include "sublimit/certificates/spectra/dart.h"
#include "sublimit/certificates/spectra/spectral_verdicts.h"

namespace sublimit {
namespace {

using By = Hypothesis::By;
using Answer = Verdict::Answer;

struct Modes {
  std::vector<AlgebraicRoot> values;  ///< each as often as its multiplicity, by modulus
  std::vector<int> blocks;            ///< of `values`: by the mirror 0 even, 1 odd
  int largest_jordan = 0;             ///< of the first value below 1, among these alone
  int largest_jordan_of_first = 0;    ///< of the first value
};

/// Rows of a block whose points are (or are not) on the curve. The curve is its own mirror image, so each block falls
/// apart like the whole.
std::vector<Index> rows_of(const ExactBlocks& blocks, size_t k, const std::vector<Index>& curve, bool on_curve) {
  std::vector<Index> rows;
  for (size_t i = 0; i < blocks.orbits[k].size(); ++i)
    if (std::binary_search(curve.begin(), curve.end(), blocks.orbits[k][i][0]) == on_curve)
      rows.push_back(static_cast<Index>(i));
  return rows;
}

/// Eigenvalues of the rows and columns whose points are (or are not) on the curve, each as often as its multiplicity,
/// by modulus.
Modes modes_of(const ExactBlocks& blocks, const std::vector<Index>& curve, bool on_curve) {
  std::vector<ExactEigenvalue> all;
  for (size_t k = 0; k < blocks.blocks.size(); ++k) {
    const std::vector<Index> rows = rows_of(blocks, k, curve, on_curve);
    const DenseMatrix<Algebraic> part = blocks.blocks[k](rows, rows);
    for (ExactEigenvalue& value : exact_eigenvalues(part)) {
      value.block = static_cast<int>(k);
      all.push_back(std::move(value));
    }
  }
  std::stable_sort(all.begin(), all.end(), [](const ExactEigenvalue& a, const ExactEigenvalue& b) {
    return compare_moduli(a.value, b.value) > 0;
  });
  Modes modes;
  for (const ExactEigenvalue& value : all) {
    modes.values.insert(modes.values.end(), value.multiplicity, value.value);
    modes.blocks.insert(modes.blocks.end(), value.multiplicity, value.block);
  }
  for (const ExactEigenvalue& value : all)
    if (value.value == all[0].value)
      modes.largest_jordan_of_first = std::max(modes.largest_jordan_of_first, value.largest_jordan());
  for (size_t i = 1; i < all.size(); ++i)
    if (all[i].value == all[1].value) modes.largest_jordan = std::max(modes.largest_jordan, all[i].largest_jordan());
  return modes;
}

/// The same neighbourhood with another ring: around one face the smallest closed set has only points on the border.
std::optional<ExactAnalysis> with_interior(const ExactAnalysis& analysis) {
  const LocalPatch<Algebraic>& patch = analysis.patch;
  const auto same = local_patch(analysis.scheme, patch.type), wider = local_patch(analysis.scheme, patch.type, 2);
  if (!same || !wider || !is_same_matrix(*same, patch) || wider->slots.size() == patch.slots.size())
    return std::nullopt;
  return open_analysis(analysis.scheme, *wider);
}

/// Tells whether a simple mode of the interior is, at the points around the centre, on both sides of the curve, where
/// it vanishes; an odd one is if it has any such point. Nothing where no eigenvector could be enclosed.
std::optional<bool> is_on_both_sides(const ExactAnalysis& analysis, const std::vector<Index>& curve,
                                     const AlgebraicRoot& value, int block) {
  const ExactBlocks& blocks = analysis.spectrum.blocks;
  const auto k = static_cast<size_t>(block);
  const std::vector<Index> rows = rows_of(blocks, k, curve, false);
  const std::optional<std::vector<ComplexBall>> heights =
      enclosed_eigenvector(DenseMatrix<Algebraic>(blocks.blocks[k](rows, rows)), value);
  if (!heights) return std::nullopt;
  bool above = false, below = false;
  for (size_t i = 0; i < rows.size(); ++i) {
    const SectorLabel& label = analysis.patch.labels[size_t(blocks.orbits[k][size_t(rows[i])][0])];
    if (label.x2 > 2 || label.y2 > 2) continue;
    const Ball height = (*heights)[i].re();
    above |= certainly_positive(height) || (block == 1 && certainly_negative(height));
    below |= certainly_negative(height) || (block == 1 && certainly_positive(height));
  }
  return above && below;
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
  if (inside.empty())
    if (const std::optional<ExactAnalysis> wider = with_interior(analysis)) return tangent_plane(*wider);
  const ExactBlocks& blocks = analysis.spectrum.blocks;
  const Modes curve_modes = modes_of(blocks, curve, true), inner_modes = modes_of(blocks, curve, false);
  const std::vector<AlgebraicRoot>&along = curve_modes.values, &across = inner_modes.values;
  // A border without rules of its own has two straight ends, like a corner.
  const bool kinked = !corner && along.size() > 2 && along[2] == along[1], two_curves = corner || kinked;
  const size_t tangents = two_curves ? 2 : 1;
  const bool has_tangents = along.size() > tangents && is_positive(along[1]) && along[tangents] == along[1] &&
                            curve_modes.largest_jordan == 1 &&
                            (along.size() == tangents + 1 || compare_moduli(along[tangents + 1], along[1]) < 0);
  const AlgebraicRoot t = along.size() > 1 ? along[1] : AlgebraicRoot();
  v.hypotheses.push_back({corner   ? "the two curves at the corner have tangents"
                          : kinked ? "the two ends of the border curve have tangents of their own"
                                   : "the border curve has a tangent",
                          has_tangents, By::exact, t.text()});
  if (!has_tangents) {
    v.because = "the modes of the border curve are not those of a smooth curve";
    return v;
  }
  // The first mode of the interior that must not lead: between two curves the first, else the second.
  const size_t at = two_curves ? 0 : 1;
  const AlgebraicRoot rival = at < across.size() ? across[at] : AlgebraicRoot(Algebraic(0));
  const int order = compare_moduli(rival, t);
  const std::string name = two_curves ? "the first mode of the interior" : "the second mode of the interior";
  v.hypotheses.push_back({name + " is smaller than the tangent's", order < 0, order == 0 ? By::exact : By::enclosure,
                          rival.text() + " against " + t.text()});
  int longest = 1;  // Jordan block of the tangent's eigenvalue, even or odd
  for (const ExactEigenvalue& value : analysis.spectrum.values)
    if (value.value == t) longest = std::max(longest, value.largest_jordan());
  const bool defective = longest > 1;
  // The first mode of the interior alone next to the tangent, and both even or both odd.
  const bool leads = !two_curves && !across.empty() && (across.size() == 1 || compare_moduli(across[1], across[0]) < 0);
  const bool is_tied = !two_curves && across.size() > 1 && !leads;
  const bool folds = leads && blocks.blocks.size() == 2 && inner_modes.blocks[0] == curve_modes.blocks[1];
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
  } else if (folds) {
    v.answer = Answer::disproved;
    v.hypotheses.push_back({"the first mode of the interior is even or odd under the mirror as the tangent's is not",
                            false, By::exact, across[0].text()});
    v.because =
        "the first mode of the interior is odd under the mirror like the tangent's: the Jacobian determinant of both "
        "changes its sign there, and the surface folds";
  } else if (is_tied && compare_moduli(across[0], t) < 0 &&
             (along.size() < 3 || compare_moduli(along[2], across[0]) <= 0)) {
    const bool one_chain = across[1] == across[0] && inner_modes.largest_jordan_of_first > 1;
    v.answer = one_chain ? Answer::borderline : Answer::evidence_against;  // not known whether limits show both
    v.hypotheses.push_back({"the first mode of the interior is larger than the second", false, By::exact,
                            across[0].text() + " and " + across[1].text()});
    v.because = one_chain
                    ? "the first modes of the interior are one Jordan block: the plane is reached, but like 1/steps"
                    : "two modes of the interior shrink alike: normals on the border are spanned by the tangent "
                      "and what data take of both, which need not be one direction";
  } else if (!two_curves && compare_moduli(across[0], t) == 0 && defective) {
    v.answer = Answer::borderline;
    v.because = "the first mode of the interior and the tangent share a Jordan block of size " +
                std::to_string(longest) + ": the plane is reached, but like 1/steps";
  } else if (!two_curves && along.size() > 2 && (across.empty() || compare_moduli(along[2], across[0]) > 0)) {
    // As around one triangle: whatever is inside shrinks faster than the curve bends.
    const bool alone = is_positive(along[2]) && (along.size() == 3 || compare_moduli(along[3], along[2]) < 0);
    v.hypotheses.push_back({"the second mode of the border curve is real, positive, and larger than the modes after it",
                            alone, By::exact, along[2].text()});
    v.because = "the second mode of the border curve leads before the first of the interior";
    if (!alone) return v;
    v.answer = Answer::evidence_for;
    v.hypotheses.push_back({"the map of the two leading modes is regular and injective", std::nullopt, By::exact});
    v.because = "the tangent along the curve and the curve's second mode, how it bends, lead";
  } else if (!two_curves && (across.empty() || !is_positive(across[0]))) {
    v.because = across.empty() ? "there are no modes but those of the tangent"
                               : "the first mode of the interior is not positive: " + across[0].text();
  } else if (const std::optional<bool> both =
                 leads ? is_on_both_sides(analysis, curve, across[0], inner_modes.blocks[0]) : false;
             both == true) {
    v.answer = Answer::evidence_against;
    v.hypotheses.push_back({"the first mode of the interior is on one side of the border curve, at the points around",
                            false, By::enclosure, across[0].text()});
    v.because = "the first mode of the interior has points around on both sides of the border curve";
  } else {
    v.answer = Answer::evidence_for;
    if (!both)
      v.hypotheses.push_back({"the first mode of the interior is on one side of the border curve, at the points around",
                              std::nullopt, By::enclosure, across[0].text()});
    v.hypotheses.push_back({"the map of the two leading modes is regular and injective", std::nullopt, By::exact});
    v.because = two_curves ? "the tangents of the two curves lead"
                           : "the tangent along the curve and the first mode of the interior lead";
  }
  return v;
}

}  // namespace sublimit
