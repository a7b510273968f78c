// SPDX-License-Identifier: Apache-2.0
#pragma once
// How knot intervals go from level to level.
#include "sublimit/mesh/knot_intervals.h"
#include "sublimit/splits/split.h"

namespace sublimit {

/// Intervals after a step: halves of edges have the two parts of their interval, an edge inside a face that of the
/// strip which it crosses. Of points: a child has the part of its parent's interval between the edge's knot and the new
/// one.
/// @param refinement  of `parent`: by pqq, and by dqq where intervals are of points
/// @param split       the new knots: `new_knots(intervals)`
KnotIntervals child_intervals(const Topology& parent, const Refinement& refinement, const KnotIntervals& intervals,
                              const KnotSplit& split);

}  // namespace sublimit
