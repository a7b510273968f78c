// SPDX-License-Identifier: Apache-2.0
#pragma once
// Integrals over a limit surface and over the solid that it bounds.
//
// By Gauss's theorem volume, first and second moments are integrals of polynomials over polynomial parts, which Gauss
// quadrature of their degree has exactly, but for rounding. Towards extraordinary vertices parts are cut until what is
// left is 1e-8 of the surface's size across, and counts for 1e-16. The area's integrand is a root: quadrature is
// compared with that of the quarters, and goes on until they agree.
#include <optional>

#include "sublimit/limit/limit_surface.h"

namespace sublimit {

struct LimitIntegrals {
  double area = 0;
  Eigen::Vector3d area_centroid = Eigen::Vector3d::Zero();
  /// Of closed surfaces, density 1. Volume is negative if normals point inwards.
  struct Solid {
    double volume = 0;
    Eigen::Vector3d centroid = Eigen::Vector3d::Zero();
    Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();  ///< about the centroid: of (|r|^2 - r r^T)
  };
  std::optional<Solid> solid;  ///< none where there are borders, holes or non-manifold edges
};

/// @param points  of the level, #V x 3
/// @throws InvalidParameter     points that do not fit
/// @throws UnsupportedTopology  a scheme without polynomial pieces
/// @note  Relative accuracy 1e-12 where no part is degenerate, 1e-10 of areas. The same bits for any number of threads.
LimitIntegrals limit_integrals(const LimitSurface& surface, const Points& points);

}  // namespace sublimit
