// SPDX-License-Identifier: Apache-2.0
#pragma once
// One segment of the Hermite incentre scheme (hermite_incentre.h): its new point and tangent, and its limit of
// biarcs.
//
// The angles alpha/2 and beta/2 define the new point also for alpha + beta >= pi, where C is at infinity or on
// the other side. Parallel tangents and arcs of more than half a circle are therefore no exceptions: a segment
// is convex if both angles are on the same side.
//
// Fallback, one rule for every segment that is not convex (an inflection; one angle zero, or below a millionth of the
// other; tangents and segment not in one plane): the new point lies in the perpendicular bisector plane of the
// segment, and point and tangent are such that both halves are arcs. This is the biarc of equal chords. In the
// plane, with signed angles sigma and tau of the tangents from the segment, the point is seen from P under
// (sigma - tau)/4 and the new tangent has the angle -(sigma + tau)/2. In space it is the rotation that takes
// one tangent to the other about an axis at right angles to the segment; of its two senses the one with the
// shorter curve is taken. Where both tangents point straight back along the segment there is no such biarc, or
// it is longer than a thousand segments: such a segment is first halved, the tangent of its middle being its
// direction.
#include <vector>

#include "sublimit/geometric/circular_arc.h"
#include "sublimit/geometric/geometric_scheme.h"

namespace sublimit {

/// Kind of a segment.
enum class SegmentKind {
  arc,         ///< equal angles: the segment is an arc, or straight
  convex,      ///< has an incentre
  inflection,  ///< angles are on different sides of the segment, or one of them is zero
  twisted,     ///< tangents and segment are not coplanar
  back,        ///< both tangents point (nearly) back along the segment
};

/// One step of the scheme on one segment.
struct SegmentStep {
  SegmentKind kind;
  HermitePoint point;
};
/// Returns the step of a segment from a to b.
/// @param scale  largest coordinate of the whole curve, which rounding errors are relative to
SegmentStep incentre_step(const HermitePoint& a, const HermitePoint& b, double scale);

/// The limit of one segment: 1, 2 or 4 arcs that join G^1. Each is the limit of the same number of refined
/// points.
struct SegmentLimit {
  SegmentKind kind;
  std::vector<CircularArc> arcs;

  /// Returns position and tangent at x in [0, 1]. Arcs have parameter intervals of equal length; points of
  /// level k are at multiples of 2^-k.
  HermitePoint at(double x) const;
  /// Returns the curvature, signed as in CircularArc; where two arcs meet, that of the second.
  double curvature(double x) const;
  /// Returns the place at x; where two arcs meet, the end of the first (`before`) or the start of the second.
  SegmentPlace place(double x, bool before) const;
};

/// Returns the limit of the segment from a to b. `scale` is as in `incentre_step`.
SegmentLimit incentre_segment(const HermitePoint& a, const HermitePoint& b, double scale);

}  // namespace sublimit
