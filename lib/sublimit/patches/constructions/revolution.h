// SPDX-License-Identifier: Apache-2.0
#pragma once
// Surfaces of revolution as rational nets, quadratic in u: the circle of each control point in arcs of less than
// 180 degrees.
//
//   column m of 2k + 1:  (cos(theta_m) X, sin(theta_m) X, omega Z, omega W),  theta_m = start + m delta / 2,
//   omega = 1 (m even), cos(delta / 2) (m odd)
//
// u counts arcs; u = m / 2 are equal angles, and between them u is not proportional to the angle. v is the profile's.
// Source: Versprille 1975; Piegl, Tiller 1997, "The NURBS Book", section 8.5.
#include "sublimit/patches/constructions/spline_net.h"

namespace sublimit {

/// Cosine and sine of an angle in degrees, exact if the value is 0, +-1/2 or +-1.
double cos_degrees(double angle);
double sin_degrees(double angle);

/// An axis, given as the image of the z axis under a rigid motion, whose rotation is the smallest possible.
struct Axis {
  Eigen::RowVector3d point{0, 0, 0}, direction{0, 0, 1};

  /// Returns the rotation.
  /// @throws InvalidParameter  a direction of length 0
  Eigen::Matrix3d turn() const;
};

/// Options of `revolution`.
struct RevolutionOptions {
  double start_degrees = 0;
  double sweep_degrees = 360;  ///< -360 to 360, not 0; negative angles reverse the normal
  int arcs = 0;                ///< number of arcs; 0: as few as possible of at most 90 degrees
  Axis axis{};
};

/// Returns the surface of revolution of a profile.
/// @param profile  curve in the xz plane: columns (x, z), or homogeneous (w x, w z, w)
/// @throws InvalidParameter  a sweep of 0 or of more than 360 degrees, arcs of 180 degrees or more
SplineNet revolution(const CurveNet& profile, const RevolutionOptions& options = {});

}  // namespace sublimit
