// SPDX-License-Identifier: Apache-2.0
#pragma once
// Local surfaces of the scheme of torus pieces: a torus, sphere, cylinder or plane through a point with given
// normal, principal curvatures and directions.
//
// A circle of curvature k1 (the tube) leaves the point along e1, curving towards n. It is moved around such
// that the path of the point leaves along e2 with curvature vector kappa = k2 n + g e1. The geodesic curvature
// g of this path is free: it determines the latitude of the point on the torus. g = 0 is an equator, outer (k1
// k2 > 0, |k1| >= |k2|) or inner (k1 k2 < 0); k2 = 0 with g = 1/R is the top circle; kappa = 0 is a cylinder;
// k1 = k2 is a sphere, whatever g. No formula divides by a curvature: with arcs written as sin(k s)/k and (1 -
// cos(k s))/k all cases are one formula, continuous in k1, k2 and g.
#include <cmath>

#include "sublimit/geometric/surface_point.h"

namespace sublimit {

/// Returns sin(x)/x.
inline double sinc(double x) { return x == 0 ? 1 : std::sin(x) / x; }

/// A torus through a point.
class TorusPiece {
 public:
  /// @param e1, n   orthonormal: direction of k1, and normal
  /// @param g       geodesic curvature, 1/length, any sign
  TorusPiece(const Eigen::Vector3d& origin, const Eigen::Vector3d& e1, const Eigen::Vector3d& n, double k1, double k2,
             double g);

  /// Length u along the tube, motion v around the axis (length at the origin), and height w along the normal.
  struct Coordinates {
    double u = 0, v = 0, w = 0;
  };
  /// The principal frame at a point of the surface.
  struct Frame {
    Eigen::Vector3d position, e1, e2, n;
    double k1, k2;  ///< curvatures along e1, e2; k2 is not finite on the axis of a torus
    double speed;   ///< length along e2 by v: the metric is du^2 + speed^2 dv^2

    SurfacePoint point() const { return {position, n, k1, k2, e1}; }
  };
  /// Returns the frame at (u, v).
  Frame at(double u, double v) const;

  /// Returns the foot point of x, in closed form: the nearest point, if x lies on the origin's side of the axis
  /// and of the centre of the tube. |k1 u| <= pi, and v is less than once around.
  Coordinates foot(const Eigen::Vector3d& x) const;

  /// Returns a factor from 1 at the origin to 0 half way around the tube or the axis.
  double nearness(const Coordinates& place) const;

  double geodesic() const { return g_; }

 private:
  Eigen::Vector3d origin_, e1_, e2_, n_;
  double k1_, k2_, g_;
  Eigen::Vector3d kappa_, towards_, axis_;  // curvature vector; its direction and the axis': orthonormal, even if 0
  double curvature_;                        // |kappa|
};

}  // namespace sublimit
