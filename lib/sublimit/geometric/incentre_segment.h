// SPDX-License-Identifier: Apache-2.0
#pragma once
// One segment of the Hermite incentre scheme (hermite_incentre.h): its new point and tangent, and its limit, by biarcs.
//
// The angles alpha/2 and beta/2 define the new point for alpha + beta >= pi too, where C is at infinity or behind, so
// parallel tangents and arcs of circles beyond a half are no exceptions: a convex segment has both angles on one side.
//
// Fallback, one rule for every segment that is not convex (an inflection; one angle zero, or below a millionth of the
// other; tangents and segment not in one plane): the new point lies in the plane that halves the segment at right
// angles, and point and tangent are such that both halves are arcs. This is the biarc of equal chords. In the plane,
// with signed angles sigma and tau of the tangents from the segment, the point is seen from P under (sigma - tau)/4 and
// the new tangent has the angle -(sigma + tau)/2. In space it is the rotation that takes one tangent to the other about
// an axis at right angles to the segment; of its two senses the one with the shorter curve is taken. Where both
// tangents point straight back along the segment there is no such biarc, or it is longer than a thousand segments: such
// a segment is first halved, the tangent of its middle being its direction.
#include <vector>

#include "sublimit/geometric/circular_arc.h"
#include "sublimit/geometric/geometric_scheme.h"

namespace sublimit {

enum class SegmentKind {
  arc,         ///< equal angles: an arc already, or a straight segment
  convex,      ///< has an incentre
  inflection,  ///< angles on different sides of the segment, or one of them zero
  twisted,     ///< tangents and segment not in one plane
  back,        ///< both tangents point back along the segment, nearly
};

/// One step of the scheme on one segment.
struct SegmentStep {
  SegmentKind kind;
  HermitePoint point;
};
/// @param scale  largest coordinate of the whole curve, from which rounding errors are judged
SegmentStep incentre_step(const HermitePoint& a, const HermitePoint& b, double scale);

/// The limit of one segment: 1, 2 or 4 arcs, G^1 between them, each the limit of as large a share of the refined
/// points.
struct SegmentLimit {
  SegmentKind kind;
  std::vector<CircularArc> arcs;

  /// At x in [0, 1]; every arc has as large a share. The points of level k are at multiples of 2^-k.
  HermitePoint at(double x) const;
  /// Signed as in CircularArc; where two arcs meet that of the second.
  double curvature(double x) const;
  /// Where two arcs meet, the end of the first (`before`) or the start of the second.
  SegmentPlace place(double x, bool before) const;
};

/// The limit of the segment from a to b.
SegmentLimit incentre_segment(const HermitePoint& a, const HermitePoint& b, double scale);

}  // namespace sublimit
