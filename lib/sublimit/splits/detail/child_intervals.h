// SPDX-License-Identifier: Apache-2.0
#pragma once
// Knot intervals of the next level.
#include "sublimit/mesh/knot_intervals.h"
#include "sublimit/splits/split.h"

namespace sublimit {

/// Returns the intervals after a step. Intervals of edges: halves of an edge have the two parts of its
/// interval; an edge inside a face has that of the strip which it crosses. Intervals of points: a child has the
/// part of its parent's interval between the edge's knot and the new one.
/// @param refinement  refinement of `parent` by pqq, or by dqq for intervals of points
/// @param split       the new knots: `new_knots(intervals)`
KnotIntervals child_intervals(const Topology& parent, const Refinement& refinement, const KnotIntervals& intervals,
                              const KnotSplit& split);

}  // namespace sublimit
