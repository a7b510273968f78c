// SPDX-License-Identifier: Apache-2.0
#pragma once
// Experiments on the masks of regular meshes, exactly.
#include "sublimit/certificates/algebraic.h"
#include "sublimit/report/statements/finding.h"
#include "sublimit/scheme/scheme.h"

namespace sublimit::report {

/// Directions in the plane, each as often as it counts.
using Directions = std::vector<std::vector<int>>;

/// Bidegree `degree`: both axes degree + 1 times.
Directions tensor_directions(int degree);

/// "The regular limit is the box spline of these directions", which is C^(m - 2) if the fewest directions without
/// which the rest lies on a line are m.
Finding is_box_spline(const Scheme<Algebraic>& scheme, const Directions& directions);

/// "The regular limit is C^k, being that box spline."
Finding is_smooth_box_spline(const Scheme<Algebraic>& scheme, const Directions& directions, int k);

/// "The regular limit is C^k", of any scheme: bounds of its Hoelder exponent.
Finding is_regularly_smooth(const Scheme<Algebraic>& scheme, int k);

/// "On regular meshes both have the same mask."
Finding same_regular_mask(const Scheme<Algebraic>& a, const Scheme<Algebraic>& b);

/// "The mask of a new vertex has this many points." Of interpolating schemes on triangles.
Finding vertex_mask_has_points(const Scheme<Algebraic>& scheme, int points);

}  // namespace sublimit::report
