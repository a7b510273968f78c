// SPDX-License-Identifier: Apache-2.0
#pragma once
// Measures of closed surfaces for the gallery, given as fine polygon meshes. A face of n corners counts as the
// mean of its n fans of triangles, which keeps the symmetry.
#include <span>

#include "sublimit/stencils/gallery/surface_distance.h"

namespace sublimit::gallery {

/// Returns the enclosed volume, by the divergence theorem.
double volume(const Topology& topology, const Points& points);

/// Returns the integral of the squared mean curvature, H = (k1 + k2)/2, divided by that of a sphere, 4 pi: 1
/// for a sphere of any size, more for every other closed surface. Discrete: the sum over vertices of |sum of
/// (cot a + cot b)/2 (x_j - x_i)|^2 / (4 A), where A is a third of the area of the faces around. Under
/// refinement it converges if curvature is square integrable, and grows if it is not.
double bending_energy(const Topology& topology, const Points& points);

struct Distances {
  double mean = 0;  ///< weighted by area
  double max = 0;   ///< maximum over the vertices
};
/// Returns the distances of the vertices of a surface from another surface.
Distances distances(const Topology& topology, const Points& points, const SurfaceDistance& other);

/// Returns the largest distance of a mapped vertex from the surface. For a group of maps this is the Hausdorff distance
/// of the surface from its farthest image, up to the size of faces.
double symmetry_defect(const Topology& topology, const Points& points, std::span<const Eigen::Matrix3d> maps);

}  // namespace sublimit::gallery
