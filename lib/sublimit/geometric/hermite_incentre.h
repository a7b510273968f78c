// SPDX-License-Identifier: Apache-2.0
#pragma once
// The Hermite incentre scheme: points with unit tangents. A segment PQ and the two tangent lines make a triangle PQC;
// its incentre is the new point, and the new tangent is the direction of the segment. Old data stay. (Deng and Wang
// 2010, "Incenter subdivision scheme for curve interpolation", have the same point and another tangent: not this
// scheme.)
//
// The limit. With angles alpha and beta between segment and tangents, the incentre sees the segment under alpha/2 at P
// and beta/2 at Q. The new tangent is parallel to the segment, so both halves have equal angles at their ends, alpha/2
// twice and beta/2 twice, and so has everything made from them: points of one circle each. The limit of a segment is
// the biarc through its incentre. It is G^1, the curvature is constant on each arc; circles are reproduced.
//
// Segments that are not convex have another rule: incentre_segment.h.
#include "sublimit/geometric/geometric_scheme.h"
#include "sublimit/geometric/incentre_segment.h"

namespace sublimit {

/// Returns the exact limit of a checked polygon: the segments of each curve, in order.
std::vector<std::vector<SegmentLimit>> incentre_limit(const ControlPolygon& polygon);

/// Returns the scheme. It has no options.
GeometricCurveScheme hermite_incentre(const SchemeOptions&);

}  // namespace sublimit
