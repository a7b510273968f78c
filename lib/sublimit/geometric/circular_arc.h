// SPDX-License-Identifier: Apache-2.0
#pragma once
// Circular arcs and straight segments between two points with unit tangents. All formulas use the points and
// tangents, not the centre, which may be at infinity: short and nearly straight arcs lose no digits.
#include <Eigen/Core>
#include <Eigen/Geometry>

namespace sublimit {

/// A point with a unit tangent; points in the plane have z = 0.
struct HermitePoint {
  Eigen::Vector3d position, tangent;
};

/// An arc of less than a whole circle, parametrised by the fraction x of its length, 0 <= x <= 1.
class CircularArc {
 public:
  /// @param a, b  ends whose tangents make equal angles with the chord, up to rounding; stored unchanged
  CircularArc(const HermitePoint& a, const HermitePoint& b);

  const HermitePoint& start() const { return a_; }
  const HermitePoint& end() const { return b_; }
  /// Returns position and unit tangent at x.
  HermitePoint at(double x) const;
  /// Returns 1/radius; in the plane negative if the arc turns right. 0 for a straight segment.
  double curvature() const;
  /// Returns the derivative of the tangent by length: it points to the centre, with length 1/radius; 0 for a
  /// straight segment.
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

/// Returns position and tangent of the middle of the arc with these ends, as computed by a step of the scheme.
HermitePoint middle_of_arc(const HermitePoint& a, const HermitePoint& b);

}  // namespace sublimit
