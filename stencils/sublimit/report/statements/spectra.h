// SPDX-License-Identifier: Apache-2.0
#pragma once
// Experiments on local matrices around extraordinary points, in exact arithmetic.
#include "sublimit/report/analysis/scheme_report.h"
#include "sublimit/report/statements/finding.h"

namespace sublimit::report {

/// A rule in both numbers, from its template: `both_of(misread::doo_sabin_halfway<double>(), ...<Algebraic>())`.
inline ReportedScheme both_of(Scheme<double> scheme, Scheme<Algebraic> exact) {
  return {std::move(scheme), std::move(exact), {}};
}

/// "The limit is C^1 at centres of these valences" (corners of faces, for dual schemes). Spectra are exact; that the
/// characteristic map is regular is proved where it can be, else sampled.
Finding is_c1(const ReportedScheme& scheme, const std::vector<int>& valences);

/// "Borders have a tangent plane where this many faces meet."
Finding has_border_planes(const Scheme<Algebraic>& scheme, const std::vector<int>& faces);

/// "The weights of every new point sum to 1."
Finding is_affine(const Scheme<Algebraic>& scheme, const std::vector<int>& valences);

/// "Centroids of faces stay where they are." For dual schemes.
Finding keeps_centroids(const Scheme<Algebraic>& scheme, const std::vector<int>& corners);

/// "Both rules make the same points around centres of these valences."
Finding same_rule(const Scheme<Algebraic>& a, const Scheme<Algebraic>& b, const std::vector<int>& valences,
                  int rings = -1);

}  // namespace sublimit::report
