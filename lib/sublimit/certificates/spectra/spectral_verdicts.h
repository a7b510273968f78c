// SPDX-License-Identifier: Apache-2.0
#pragma once
// Verdicts from exact spectra alone: convergence, the hypotheses of Reif's criterion, the behaviour of
// curvature, and the possible shapes. Like the theorems, the statements are about generic data.
#include <optional>
#include <vector>

#include "sublimit/certificates/spectra/exact_analysis.h"
#include "sublimit/certificates/spectra/verdict.h"

namespace sublimit {

/// Returns whether all rows of the local matrix sum to one, exactly.
Hypothesis rows_sum_to_one(const LocalPatch<Algebraic>& patch);
/// Returns whether the weights of each new point sum to 1, so that affine maps commute with refinement.
Verdict affine_invariance(const ExactAnalysis& analysis);
/// Returns whether refinement contracts the neighbourhood to one point: eigenvalue 1 is simple and dominant.
Verdict convergence(const ExactAnalysis& analysis);

/// Returns the verdict on the spectral conditions of Reif's criterion; the characteristic map is judged in map_proof.h.
/// It is `disproved` or `borderline` if the spectrum decides, `unknown` if all conditions hold and the map decides.
Verdict spectral_c1(const ExactAnalysis& analysis);

/// Subdominant and subsubdominant eigenvalues, lambda and mu, and their ratio, if Reif's hypotheses hold.
struct Subdominant {
  ExactEigenvalue lambda = {};
  std::vector<ExactEigenvalue> mu = {};  ///< all eigenvalues of the next modulus
  int mu_to_lambda2 = 0;                 ///< exact sign of |mu| - lambda^2
  Ball ratio = {};                       ///< |mu|/lambda^2
  int largest_jordan = 1;                ///< size of the largest Jordan block of mu
  std::vector<int> mu_blocks = {};       ///< Fourier blocks of mu, k = 0 ... n - 1, ascending
};
/// Returns these eigenvalues; nothing if Reif's hypotheses do not hold.
std::optional<Subdominant> subdominant(const ExactAnalysis& analysis);

/// Facts beyond the spectrum that statements of second order require. Each is a hypothesis of the verdicts that
/// use it: if it is undecided, so are they.
struct SecondOrderGiven {
  Hypothesis c1 = {"the surface is C^1 at the point", std::nullopt};
  /// Holds for piecewise polynomial C^1 surfaces, and for all C^2 ones.
  Hypothesis bounded = {"second derivatives of regular surfaces are bounded", std::nullopt};
  Hypothesis continuous = {"regular surfaces are C^2", std::nullopt};
};

/// Returns the verdict on curvature. Finding "curvature": flat, bounded, logarithmic or divergent, whatever the
/// answer.
Verdict curvature(const ExactAnalysis& analysis, const SecondOrderGiven& given);
/// Returns the verdict on possible shapes. Finding "shapes": all, elliptic, hyperbolic or other.
Verdict shapes(const ExactAnalysis& analysis, const SecondOrderGiven& given);
/// Returns the verdict on the exponents p for which curvature is integrable. Finding "p": their least upper
/// bound as a decimal; "null": every p.
Verdict curvature_integrability(const ExactAnalysis& analysis, const SecondOrderGiven& given);
/// Returns the verdict on C^2, from the spectrum.
Verdict spectral_c2(const ExactAnalysis& analysis, const SecondOrderGiven& given);

/// Returns whether one side of a border, crease or corner has a tangent plane: two modes must dominate. For
/// generic data. Regularity of the map of these modes is not checked, so a positive answer is evidence only.
Verdict tangent_plane(const ExactAnalysis& analysis);

}  // namespace sublimit
