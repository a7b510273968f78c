// SPDX-License-Identifier: Apache-2.0
#pragma once
// Smoothness of limits of regular meshes and curves, from the matrices that take differences of one level to
// those of the next. If differences shrink like rho^j, where dilation^-j is the spacing, the limit has the
// Hoelder exponent -log rho / log dilation, and is C^k if this is certainly above k. Curves and regular meshes
// differ only in these matrices.
#include <string>
#include <vector>

#include "sublimit/certificates/regularity/joint_spectral_radius.h"
#include "sublimit/certificates/regularity/rational_matrix.h"
#include "sublimit/certificates/spectra/verdict.h"

namespace sublimit {

/// Matrices whose products take differences of order `order` to those of all finer levels.
struct DifferenceTransitions {
  int order = 1;
  int dilation = 2;
  std::vector<RationalMatrix> matrices = {};
  /// True if the conditions are also necessary: differences of the limit grow like those of the points.
  bool necessary = false;
  bool stable = true;                  ///< if the limit is C^k, polynomials of degree k are generated
  std::string necessary_because = {};  ///< reason, as a hypothesis: "integer shifts are linearly independent"
};

/// Norm of `steps` steps of the scheme of differences of order `order`, applied to divided differences of order
/// - 1. Below 1 the limit is C^(order - 1).
struct DifferenceNorm {
  int order = 1, steps = 1;
  Ball norm;
};

/// Bounds of the smoothness.
struct Smoothness {
  int continuity = -1;  ///< largest k with a proof of C^k; -1: none
  /// Largest k that is not excluded; C^k is undecided above `continuity` up to this.
  int possible = 0;
  double exponent_low = 0, exponent_high = 0;  ///< proved bounds of the Hoelder exponent; C^(1,1) counts as 2
  bool has_upper_bound = false;                ///< false: exponent_high has no meaning
  std::vector<DifferenceNorm> norms = {};
  JointSpectralRadius radius = {};  ///< joint spectral radius for differences of order `order`
  int order = 0;
  std::vector<std::string> notes = {};
  std::vector<Verdict> verdicts = {};
};

/// Returns bounds of the exponent, and proofs and disproofs of C^k.
/// @param norms      norms for curves, or none
/// @param sum_rules  polynomials of degree below this are generated; their differences vanish
/// @param of_limits  transitions for differences of the limit at grid points; if given, necessary conditions
///                   use these
Smoothness smoothness(const DifferenceTransitions& transitions, const std::vector<DifferenceNorm>& norms, int sum_rules,
                      const JointSpectralRadiusOptions& options = {}, const DifferenceTransitions* of_limits = nullptr);

/// Returns an enclosure of the exponent -log(radius)/log(dilation); exact for powers of two at dilation 2.
Ball exponent_of(double radius, int dilation);

/// True if 1 or -1 is an eigenvalue of factor A; decided exactly.
bool has_unit_eigenvalue(const RationalMatrix& A, const Rational& factor);

}  // namespace sublimit
