// SPDX-License-Identifier: Apache-2.0
#pragma once
// What spectra alone decide, from exact masks: convergence, the hypotheses of Reif's criterion and their failure, how
// curvature behaves, which shapes there are. Statements hold for generic data, as these theorems do.
#include <optional>
#include <vector>

#include "sublimit/certificates/detail/exact_analysis.h"
#include "sublimit/limit/detail/verdict.h"

namespace sublimit {

/// Returns an exact verdict, by all rows of the local matrix.
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
  std::vector<ExactEigenvalue> mu = {};  ///< all of the next modulus
  int mu_to_lambda2 = 0;                 ///< sign of |mu| - lambda^2, exactly
  Ball ratio = {};                       ///< |mu|/lambda^2
  int largest_jordan = 1;                ///< of mu
  std::vector<int> mu_blocks = {};       ///< k = 0 ... n - 1, ascending
};
std::optional<Subdominant> subdominant(const ExactAnalysis& analysis);

/// Facts that statements of second order need besides the spectrum. Each becomes a hypothesis of the verdicts that use
/// it: if it is not known to hold, neither are they.
struct SecondOrderGiven {
  Hypothesis c1 = {"the surface is C^1 at the point", std::nullopt};
  /// Holds for piecewise polynomial C^1 surfaces, and for all C^2 ones.
  Hypothesis bounded = {"second derivatives of regular surfaces are bounded", std::nullopt};
  Hypothesis continuous = {"regular surfaces are C^2", std::nullopt};
};

/// Finding "curvature": flat, bounded, logarithmic or divergent, whatever the answer.
Verdict curvature(const ExactAnalysis& analysis, const SecondOrderGiven& given);
/// Finding "shapes": all, elliptic, hyperbolic or other.
Verdict shapes(const ExactAnalysis& analysis, const SecondOrderGiven& given);
/// Finding "p": the least upper bound of exponents, as a decimal; "null": every p.
Verdict curvature_integrability(const ExactAnalysis& analysis, const SecondOrderGiven& given);
Verdict spectral_c2(const ExactAnalysis& analysis, const SecondOrderGiven& given);

/// One side of a border, a crease or a corner: which two modes lead. An argument for generic data; that the map of the
/// two modes is regular is not looked at, so what holds is evidence.
Verdict tangent_plane(const ExactAnalysis& analysis);

}  // namespace sublimit
