// SPDX-License-Identifier: Apache-2.0
#pragma once
// How many rings of faces around it a piece depends on.
#include "sublimit/scheme/scheme.h"

namespace sublimit {

/// Returns the least number of rings of faces around a piece that is enough: the points in as many rings around each of
/// its children depend on no others. Computed from the masks on labelled meshes (mask_reach.h), between equal knot
/// intervals and for edges that decay uniformly.
/// @throws AnalysisError  masks reach beyond `most_rings`
int piece_rings(const Scheme<double>& scheme);

}  // namespace sublimit
