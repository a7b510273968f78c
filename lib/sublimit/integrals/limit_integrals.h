// SPDX-License-Identifier: Apache-2.0
#pragma once
// Integrals over limit surfaces and patches: the area, and, if they are closed, volume, centre and inertia of the solid
// inside.
//
//   const LimitIntegrals integrals = limit_integrals(surface.map(), surface.points());
//   std::cout << "area " << integrals.area << "\n";
//   if (integrals.solid) std::cout << "volume " << integrals.solid->volume << "\n";
//
// By the divergence theorem moments of a solid are integrals over its surface, homogeneous in X = (x, y, z):
//
//   integral of 1, X, X X^T over the solid  =  integral of (X.N) (1/3, X/4, X X^T/5) over u and v,  N = X_u x X_v
//
// On a polynomial piece the integrand is a polynomial, and Gauss quadrature of its degree is exact up to rounding.
// Around extraordinary vertices a piece consists of rings that shrink by the subdominant eigenvalue lambda from level
// to level, so their areas by lambda^2: they are summed one by one until the rest is below the rounding of the sum,
// after 30 / log2(1/lambda) rings (35 at valence 5). The closed sum by eigenvalues has the same digits but needs n^3
// numbers for n points around a piece, and areas have none. Limits without polynomial pieces are refined.
#include <Eigen/Core>

#include <optional>
#include <string>

#include "sublimit/patches/patches.h"
#include "sublimit/surface/limit_map.h"

namespace sublimit {

/// Integrals over the solid of density 1 that a closed surface bounds. Errors are estimates, 0 if only rounding is
/// left.
struct SolidIntegrals {
  double volume = 0;  ///< negative if normals point inwards
  double volume_error = 0;
  Eigen::Vector3d centroid;
  double centroid_error = 0;
  Eigen::Matrix3d inertia;   ///< about the centroid
  double inertia_error = 0;  ///< error of `inertia` in the Frobenius norm
};

/// Integrals over a surface. Plain data.
struct [[nodiscard]] LimitIntegrals {
  double area = 0;
  double area_error = 0;                    ///< estimated by halving squares, or by leaving levels out
  std::optional<Eigen::Vector3d> centroid;  ///< centroid of the surface; absent if the area is 0
  double centroid_error = 0;
  std::optional<SolidIntegrals> solid;  ///< present if the surface is closed
  std::string why_no_solid;             ///< reason if there is none, else empty
};

/// Returns integrals over all of the limit but its holes.
///
/// Volume and moments of polynomial pieces are exact but for rounding, about 1e-14 of area times diameter (and its
/// powers). The area has no closed form: squares are halved until two Gauss rules differ by less than 2e-13 of the
/// square of the extent of the points that a piece depends on. `area_error` sums these differences: below 1e-10 of the
/// area, but for vertices of hundreds of faces, which are slivers (5e-10 at one of 360).
///
/// If a scheme has no polynomial pieces (butterfly, sqrt3, kobbelt), or none along borders (mid-edge, averaging of
/// degrees above 3), all integrals are extrapolated from refined meshes of up to a million faces. For meshes of some
/// tens of faces the relative errors are 1e-9 to 1e-4, more for meshes that cannot be refined as often. The solid of a
/// surface that intersects itself counts every point by its winding number.
/// @param points  control points of the map's level, #V x 3
/// @return  the same bits for any number of threads
/// @throws InvalidParameter     points that do not fit
/// @throws InvalidMesh          points that are not finite, or so large that an integral is not
/// @throws UnsupportedTopology  holes, if the integrals are extrapolated and faces of a level lie on several of the
///                              level before (sqrt3, dual schemes)
/// @throws ResourceError        two levels of the refined mesh take more memory than there is
LimitIntegrals limit_integrals(const LimitMap& surface, const Points& points);

/// Returns integrals over all faces of patches, by Gauss rules on cells that are quartered until their sums change by
/// less than 2e-13 of the square of the extent of all control points. Volume and moments of polynomial patches are
/// exact but for rounding. Patches are closed if each of their sides is another one's too, or a single point.
/// @return  the same bits for any number of threads
/// @throws InvalidMesh          control points that are not finite, or so large that an integral is not
/// @throws UnsupportedTopology  a face with a pole, where w = 0: names it
LimitIntegrals limit_integrals(const Patches& patches);

}  // namespace sublimit
