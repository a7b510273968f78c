// SPDX-License-Identifier: Apache-2.0
#pragma once
// Sharp edges inside a surface: sides of creases, whose matrix equals that of a border if the rules do, and
// darts, where one sharp edge ends at a vertex with smooth rules. A dart has no rotational symmetry, but mirror
// symmetry at its sharp edge.
#include "sublimit/certificates/spectra/exact_analysis.h"
#include "sublimit/certificates/spectra/verdict.h"

namespace sublimit {

/// Returns the local matrix of one side of a crease, with `faces` faces on this side of the vertex (and three
/// on the other).
/// @return  nothing for schemes without sharp edges
template <class T>
std::optional<LocalPatch<T>> crease_patch(const Scheme<T>& scheme, int faces, int rings = -1) {
  if (scheme.sharpening == Sharpening::boundary) return std::nullopt;
  // Three faces on the other side, so that no valence is too small.
  const Mesh mesh = creased_fan(faces + 3, faces, scheme.face_size() == 3 ? 3 : 4);
  return local_patch(scheme, {.faces = faces, .open = true}, rings, &mesh);
}

/// True if two patches have the same points and exactly the same matrix, and therefore the same masks and
/// verdicts.
bool is_same_matrix(const LocalPatch<Algebraic>& a, const LocalPatch<Algebraic>& b);

/// Returns the local matrix of a dart. Labels are those of a closed vertex whose sector 0 starts at the sharp
/// edge; `outline` has the points of that edge.
/// @param n  valence
/// @return  nothing for schemes without darts
template <class T>
std::optional<LocalPatch<T>> dart_patch(const Scheme<T>& scheme, int n, int rings = -1) {
  if (scheme.sharpening != Sharpening::semi_sharp || scheme.is_dual()) return std::nullopt;
  const Mesh mesh = creased_fan(n, n, scheme.face_size() == 3 ? 3 : 4);
  return local_patch(scheme, {.faces = n, .open = true}, rings, &mesh);
}

/// Returns the analysis of a dart or another open neighbourhood. If it is mirror symmetric, its spectrum has
/// block 0 for even modes and block 1 for odd ones.
ExactAnalysis open_analysis(const Scheme<Algebraic>& scheme, LocalPatch<Algebraic> patch);

/// Returns whether there is one tangent plane around the dart: one even mode and one odd mode must dominate.
/// For generic data. Regularity of the map of the two modes is not checked, so a positive answer is evidence
/// only.
Verdict dart_tangent_plane(const ExactAnalysis& analysis);

}  // namespace sublimit
