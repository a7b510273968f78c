// SPDX-License-Identifier: Apache-2.0
#pragma once
// Control points whose limit is near to a level set: places of the limit, the nearest points of the surface as targets,
// least squares of distances from tangent planes, and again. As fit_cloud does, but with targets by Newton's method on
// the field instead of given points.
#include <functional>

#include "sublimit/implicit/detail/cage.h"
#include "sublimit/surface/limit_map.h"

namespace sublimit {

/// Normals further than that from the gradient, in radians: faces are folded, the cage does not show the shape.
inline constexpr double folded_angle = 1;

/// Distances of a limit from a level set.
struct LevelSetError {
  Index samples = 0;
  double largest = 0, mean = 0;  ///< of |F| / |grad F|, the distance to first order
  Eigen::Vector3d worst;         ///< where it is largest
  double largest_angle = 0;      ///< between limit normals and the gradient, radians
  double mean_angle = 0;
  Index curvatures = 0;                  ///< places where the limit and the field have second derivatives
  double gauss = 0, mean_curvature = 0;  ///< there: means of |difference| to the curvature of the level set
  /// Faces are folded or inside out: near to the surface, they need not cover it.
  bool is_folded() const { return largest_angle > folded_angle; }
};

/// True if a is the better one. Folded ones are last: a limit that is all at one point of a surface has no distance.
bool is_nearer(const LevelSetError& a, const LevelSetError& b);

struct [[nodiscard]] LevelSetFit {
  Points points;               ///< control points
  LevelSetError error;         ///< of them
  std::vector<double> rounds;  ///< largest distances, the first guess before them
};

/// @param surface  of the cage's mesh with its tags
/// @param rounds   of projection and least squares
LevelSetFit fit_level_set(const LimitMap& surface, const Cage& cage, const FieldSides& sides, int rounds,
                          const std::function<void(int)>& progress = {});

/// Measured on grids of N x N places a face, normals beside the gradient of the side that the face is of.
/// @param curved  whether to compare curvatures, too
LevelSetError level_set_error(const LimitMap& surface, const Points& points, const Cage& cage, const FieldSides& sides,
                              int N = 7, bool curved = true);

}  // namespace sublimit
