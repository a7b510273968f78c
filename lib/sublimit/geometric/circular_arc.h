// SPDX-License-Identifier: Apache-2.0
#pragma once
// A circular arc, or a straight segment, between two points with unit tangents. All formulas are in the points and the
// tangents themselves: short and nearly straight arcs lose no digits, and there is no centre that runs to infinity.
#include <Eigen/Core>
#include <Eigen/Geometry>

namespace sublimit {

/// An end of an arc or of a segment; points of the plane have z = 0.
struct HermitePoint {
  Eigen::Vector3d position, tangent;
};

/// Evaluable at any x in [0, 1], the fraction of its length. Any turn up to, not including, the whole circle.
class CircularArc {
 public:
  /// @param a, b  ends whose tangents make equal angles with the chord, up to rounding; they are kept bitwise
  CircularArc(const HermitePoint& a, const HermitePoint& b);

  const HermitePoint& start() const { return a_; }
  const HermitePoint& end() const { return b_; }
  /// Position and unit tangent.
  HermitePoint at(double x) const;
  /// 1/radius; in the plane negative where the arc turns right. 0 for a straight segment.
  double curvature() const;
  /// Derivative of the tangent by length: towards the centre, 1/radius long; 0 for a straight segment.
  Eigen::Vector3d curvature_vector(double x) const;
  double turn() const { return 2 * half_turn_; }  ///< angle between the end tangents, in [0, 2 pi)
  double length() const;
  bool straight() const { return sine_ == 0; }
  double radius() const;           ///< infinity for a straight segment
  Eigen::Vector3d centre() const;  ///< not finite for a straight segment

 private:
  double share(double x) const;  // sin(x half_turn) / sin(half_turn), x if straight

  HermitePoint a_, b_;
  Eigen::Vector3d chord_, rise_;  // b - a; (tangent at a - tangent at b)/2, of length sin(half_turn)
  double width_, half_turn_, sine_;
};

/// The middle of the arc with these ends, its position and tangent as the scheme's step makes them.
HermitePoint middle_of_arc(const HermitePoint& a, const HermitePoint& b);

}  // namespace sublimit
