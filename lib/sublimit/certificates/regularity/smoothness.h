// SPDX-License-Identifier: Apache-2.0
#pragma once
// How smooth limits of a regular arrangement are, from the matrices that take differences of one level to those of the
// next: if these shrink like rho^j, dilation^-j being the spacing, the limit has Hoelder exponent -log rho / log
// dilation, and is C^k where that is certainly above k. Smoothness of curves and of regular meshes differs only in how
// the matrices come about.
#include <string>
#include <vector>

#include "sublimit/certificates/regularity/joint_spectral_radius.h"
#include "sublimit/certificates/regularity/rational_matrix.h"
#include "sublimit/limit/detail/verdict.h"

namespace sublimit {

/// Matrices whose products take differences of order `order` to those of all finer levels.
struct DifferenceTransitions {
  int order = 1;
  int dilation = 2;
  std::vector<RationalMatrix> matrices = {};
  /// The conditions are necessary: differences of the limit grow as those of the points.
  bool necessary = false;
  bool stable = true;                  ///< and where the limit is C^k, polynomials of degree k are generated
  std::string necessary_because = {};  ///< in words, as a hypothesis: "integer shifts are linearly independent"
};

/// Norm of `steps` steps of the scheme of differences of order `order`, of divided differences of order - 1: below 1,
/// the limit is C^(order - 1).
struct DifferenceNorm {
  int order = 1, steps = 1;
  Ball norm;
};

struct Smoothness {
  int continuity = -1;  ///< the largest k with a proof of C^k; -1 without
  /// The largest k that is not excluded; above `continuity` where nothing was decided.
  int possible = 0;
  double exponent_low = 0, exponent_high = 0;  ///< certain bounds of the Hoelder exponent; C^(1,1) counts as 2
  bool has_upper_bound = false;                ///< else exponent_high has no meaning
  std::vector<DifferenceNorm> norms = {};
  JointSpectralRadius radius = {};  ///< of differences of `order`
  int order = 0;
  std::vector<std::string> notes = {};
  std::vector<Verdict> verdicts = {};
};

/// Bounds of the exponent, and C^k proved and disproved.
/// @param norms      those of curves, or none
/// @param sum_rules  polynomials of degree below this are generated; their differences vanish
/// @param of_limits  the same for differences of the limit at the points' places: necessary conditions come from
///                   these, if given
Smoothness smoothness(const DifferenceTransitions& transitions, const std::vector<DifferenceNorm>& norms, int sum_rules,
                      const JointSpectralRadiusOptions& options = {}, const DifferenceTransitions* of_limits = nullptr);

/// The exponent -log(radius)/log(dilation), enclosed; of a power of two at dilation 2 exactly.
Ball exponent_of(double radius, int dilation);

/// 1 or -1 is an eigenvalue of dilation^k times one of the matrices, exactly.
bool has_unit_eigenvalue(const RationalMatrix& A, const Rational& factor);

}  // namespace sublimit
