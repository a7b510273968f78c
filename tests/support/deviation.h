// SPDX-License-Identifier: Apache-2.0
#pragma once
// How far refined data are from a surface that is known, and from themselves: the measure of schemes of which nothing
// is proved.
#include <Eigen/Core>

#include <functional>
#include <vector>

#include "sublimit/geometric/curvature_mesh.h"
#include "sublimit/geometric/geometric_scheme.h"
#include "sublimit/geometric/surface_point.h"

namespace sublimit::testing {

/// The surface f = 0 near which |gradient| > 0; normals along the gradient.
struct ImplicitSurface {
  struct Jet {
    double value = 0;
    Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
    Eigen::Matrix3d hessian = Eigen::Matrix3d::Zero();
  };
  std::function<Jet(const Eigen::Vector3d&)> at;
};

/// Everything of second order at the surface's point nearest to x, by Newton's method from x: for x near to it.
/// @throws InvalidParameter  no convergence
SurfacePoint nearest_point(const ImplicitSurface& surface, const Eigen::Vector3d& x);

/// The largest and the root mean square of something.
struct Spread {
  double largest = 0, mean_square_root = 0;
};
/// One level; of all vertices, in lengths, radians and 1/lengths.
struct Deviation {
  int level = 0;
  Index vertices = 0;
  double edge = 0;    ///< longest edge
  Spread position;    ///< distance from the surface
  Spread normal;      ///< angle to the normal at the nearest point
  Spread k1, k2;      ///< of sorted curvatures: the larger, the smaller
  Spread triangle;    ///< between the normal of a triangle and the data normals of its corners
  Spread neighbours;  ///< between the normals of the triangles of an edge
  Spread bend;        ///< `neighbours` by the distance between the centroids: grows like 1/edge where normals jump
};

/// Data of level 0 to `levels` against `surface`.
/// @throws what the scheme throws; InvalidParameter  points too far from the surface
std::vector<Deviation> deviations(const GeometricScheme<CurvatureMesh>& scheme, const CurvatureMesh& mesh, int levels,
                                  const ImplicitSurface& surface);

/// Exact data of the surface at the points of it nearest to a mesh's vertices: targets to start from.
std::vector<VertexTarget> targets_on(const ImplicitSurface& surface, const Mesh& mesh);

}  // namespace sublimit::testing
