// SPDX-License-Identifier: Apache-2.0
#pragma once
// The Hermite incentre scheme: points with unit tangents. A leg PQ and the two tangent lines make a triangle PQC; its
// incentre is the new point, and the new tangent is the direction of the leg. Old data stay. (Deng and Wang 2010,
// "Incenter subdivision scheme for curve interpolation", have the same point and another tangent: not this scheme.)
//
// The limit. With angles alpha and beta between leg and tangents, the incentre sees the leg under alpha/2 at P and
// beta/2 at Q. The new tangent is parallel to the leg, so both halves have equal angles at their ends, alpha/2 twice
// and beta/2 twice, and so has everything made from them: points of one circle each. The limit of a leg is the biarc
// through its incentre. It is G^1, the curvature is constant on each arc; circles are reproduced.
//
// The angles alpha/2 and beta/2 define the new point for alpha + beta >= pi too, where C is at infinity or behind, so
// parallel tangents and arcs of circles beyond a half are no exceptions: a convex leg has both angles on one side.
//
// Fallback, one rule for every leg that is not convex (an inflection; one angle zero, or below a millionth of the
// other; tangents and leg not in one plane): the new point lies in the plane that halves the leg at right angles, and
// point and tangent are such that both halves are arcs. This is the biarc of equal chords. In the plane, with signed
// angles sigma and tau of the tangents from the leg, the point is seen from P under (sigma - tau)/4 and the new tangent
// has the angle -(sigma + tau)/2. In space it is the rotation that takes one tangent to the other about an axis at
// right angles to the leg; of its two senses the one with the shorter curve is taken. Where both tangents point
// straight back along the leg there is no such biarc, or it is longer than a thousand legs: such a leg is first halved,
// the tangent of its middle being its direction.
#include "sublimit/circular_arc.h"
#include "sublimit/geometric_scheme.h"

namespace sublimit {

enum class LegKind {
  arc,         ///< equal angles: an arc already, or a straight segment
  convex,      ///< has an incentre
  inflection,  ///< angles on different sides of the leg, or one of them zero
  twisted,     ///< tangents and leg not in one plane
  back,        ///< both tangents point back along the leg, nearly
};

/// One step of the scheme on one leg.
struct LegStep {
  LegKind kind;
  HermitePoint point;
};
/// @param scale  largest coordinate of the whole curve, from which rounding errors are judged
LegStep incentre_step(const HermitePoint& a, const HermitePoint& b, double scale);

/// The limit of one leg: 1, 2 or 4 arcs, G^1 between them, each the limit of as large a share of the refined points.
struct LegLimit {
  LegKind kind;
  std::vector<CircularArc> arcs;

  /// At x in [0, 1]; every arc has as large a share. The points of level k are at multiples of 2^-k.
  HermitePoint at(double x) const;
  /// Signed as in CircularArc; where two arcs meet that of the second.
  double curvature(double x) const;
  /// Where two arcs meet, the end of the first (`before`) or the start of the second.
  LegPlace place(double x, bool before) const;
};

/// The exact limit of a checked polygon: of each curve, its legs in order.
std::vector<std::vector<LegLimit>> incentre_limit(const ControlPolygon& polygon);

GeometricCurveScheme hermite_incentre(const SchemeOptions&);

}  // namespace sublimit
