// SPDX-License-Identifier: Apache-2.0
#pragma once
// Integrals over the limit: area, and of a closed surface volume, centre and inertia of the solid inside.
//
// By the divergence theorem moments of a solid are integrals over its surface, homogeneous in X = (x, y, z):
//
//   integral of 1, X, X X^T over the solid  =  integral of (X.N) (1/3, X/4, X X^T/5) over u and v,  N = X_u x X_v
//
// On a polynomial piece the integrand is a polynomial, and Gauss quadrature of its degree is exact up to rounding.
// Around extraordinary vertices a piece consists of rings that shrink by the subdominant eigenvalue lambda from level
// to level, so their areas by lambda^2: they are summed one by one until the rest is below the rounding of the sum.
#include <Eigen/Core>

#include <optional>
#include <string>

#include "sublimit/limit/limit_surface.h"

namespace sublimit {

/// Of the solid that a closed surface bounds, of density 1.
struct SolidIntegrals {
  double volume = 0;  ///< negative where normals point inwards
  Eigen::Vector3d centroid;
  Eigen::Matrix3d inertia;  ///< about the centroid
};

struct LimitIntegrals {
  double area = 0;
  double area_error = 0;                    ///< estimated by halving squares, and what was left out
  std::optional<Eigen::Vector3d> centroid;  ///< of the surface; none without an area
  std::optional<SolidIntegrals> solid;
  std::string why_no_solid;  ///< empty where there is one
};

/// Integrals over all of the limit but its holes.
///
/// Volume and moments are exact but for rounding, about 1e-14 of area times diameter (and its powers). The area has no
/// closed form: squares are halved until two Gauss rules differ by less than 2e-13 of the square of the extent of the
/// points that a piece depends on. `area_error` sums these differences: below 1e-10 of the area, but for vertices of
/// hundreds of faces, which are slivers (5e-10 at one of 360). The solid of a surface that intersects itself counts
/// every point by its winding number.
/// @param points  of the level, #V x 3
/// @return  the same bits for any number of threads
/// @throws InvalidParameter  points that do not fit, or are not finite
/// @throws InvalidOption     a scheme whose limit has no polynomial pieces (butterfly, sqrt3, kobbelt)
/// @throws UnsupportedTopology  no polynomial pieces along borders or creases (mid-edge, averaging of degrees above 3)
LimitIntegrals limit_integrals(const LimitSurface& surface, const Points& points);

}  // namespace sublimit
