// SPDX-License-Identifier: Apache-2.0
#pragma once
// Deviations of refined data from a known surface, and from each other, to assess schemes without proofs.
#include <Eigen/Core>

#include <functional>
#include <vector>

#include "sublimit/geometric/curvature_mesh.h"
#include "sublimit/geometric/geometric_scheme.h"
#include "sublimit/geometric/surface_point.h"

namespace sublimit::testing {

/// The surface f = 0, near which |gradient| > 0. Normals have the direction of the gradient.
struct ImplicitSurface {
  struct Jet {
    double value = 0;
    Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
    Eigen::Matrix3d hessian = Eigen::Matrix3d::Zero();
  };
  std::function<Jet(const Eigen::Vector3d&)> at;
};

/// Returns the point of the surface nearest to x, with its second-order data, by Newton's method from x. x must
/// be near the surface.
/// @throws InvalidParameter  no convergence
SurfacePoint nearest_point(const ImplicitSurface& surface, const Eigen::Vector3d& x);

/// Largest value and root mean square.
struct Spread {
  double largest = 0, mean_square_root = 0;
};
/// Deviations of a level, over all its vertices, in lengths, radians and 1/lengths.
struct Deviation {
  int level = 0;
  Index vertices = 0;
  double edge = 0;    ///< longest edge
  Spread position;    ///< distance from the surface
  Spread normal;      ///< angle to the normal at the nearest point
  Spread k1, k2;      ///< errors of the larger and the smaller principal curvature
  Spread triangle;    ///< angle between the normal of a triangle and the given normals of its corners
  Spread neighbours;  ///< angle between the normals of neighbouring triangles
  Spread bend;        ///< `neighbours` over the distance of centroids: grows like 1/edge if normals jump
};

/// Returns the deviations of the data of levels 0 to `levels` from `surface`.
/// @throws InvalidParameter  points too far from the surface; and the errors of the scheme
std::vector<Deviation> deviations(const GeometricScheme<CurvatureMesh>& scheme, const CurvatureMesh& mesh, int levels,
                                  const ImplicitSurface& surface);

/// Returns the exact data of the surface at its points nearest to a mesh's vertices, as targets.
std::vector<VertexTarget> targets_on(const ImplicitSurface& surface, const Mesh& mesh);

}  // namespace sublimit::testing
