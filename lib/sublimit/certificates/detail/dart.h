// SPDX-License-Identifier: Apache-2.0
#pragma once
// Sharp edges inside a surface: sides of creases, whose matrix is that of a border where the rules are, and darts,
// where one sharp edge ends in a point with smooth rules. A dart has no rotation, but a mirror: its sharp edge.
#include "sublimit/certificates/detail/exact_analysis.h"
#include "sublimit/limit/detail/verdict.h"

namespace sublimit {

/// The local matrix of one side of a crease through a vertex with `faces` faces on this side and others on the other.
/// @return  nothing for schemes without sharp edges
std::optional<LocalPatch<Algebraic>> crease_patch(const Scheme<Algebraic>& scheme, int faces, int rings = -1);

/// Both have the same points and, exactly, the same matrix: then they have the same masks and verdicts.
bool is_same_matrix(const LocalPatch<Algebraic>& a, const LocalPatch<Algebraic>& b);

/// The local matrix of a dart. Its labels are those of a closed vertex, sector 0 from the sharp edge on; `outline` has
/// the points of that edge.
/// @param n  valence
/// @return  nothing for schemes without darts
std::optional<LocalPatch<Algebraic>> dart_patch(const Scheme<Algebraic>& scheme, int n, int rings = -1);

/// The local matrix of a dart, or of anything open, with its spectrum: block 0 of even modes, block 1 of odd ones,
/// where the neighbourhood is its own mirror image.
ExactAnalysis open_analysis(const Scheme<Algebraic>& scheme, LocalPatch<Algebraic> patch);

/// Returns whether there is one tangent plane around the dart: one even mode and one odd mode must dominate. An
/// argument for generic data; that the map of the two modes is regular is not looked at, so what holds is evidence.
Verdict dart_tangent_plane(const ExactAnalysis& analysis);

}  // namespace sublimit
