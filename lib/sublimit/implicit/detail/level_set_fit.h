// SPDX-License-Identifier: Apache-2.0
#pragma once
// Control points whose limit approximates a level set. Iterates: project places of the limit onto the surface
// by Newton's method on the field, then minimise the distances from the tangent planes there by least squares.
// Like fit_cloud, with computed targets instead of given points.
#include <functional>

#include "sublimit/implicit/detail/cage.h"
#include "sublimit/surface/limit_map.h"

namespace sublimit {

/// Angle between normals and gradients, in radians, above which faces count as folded: the cage does not have
/// the shape.
inline constexpr double folded_angle = 1;

/// Distances of a limit from a level set.
struct LevelSetError {
  Index samples = 0;
  double largest = 0, mean = 0;  ///< largest and mean |F| / |grad F|, the distance to first order
  Eigen::Vector3d worst;         ///< place of the largest
  double largest_angle = 0;      ///< largest angle between limit normals and gradients, radians
  double mean_angle = 0;
  Index curvatures = 0;                  ///< number of places where limit and field have second derivatives
  double gauss = 0, mean_curvature = 0;  ///< mean absolute error of both curvatures at these places
  /// True if faces are folded or inside out. They may then be near the surface without covering it.
  bool is_folded() const { return largest_angle > folded_angle; }
};

/// True if a is better than b. Folded ones are worst: a limit that is a single point of the surface has
/// distance 0.
bool is_nearer(const LevelSetError& a, const LevelSetError& b);

/// Result of a fit.
struct [[nodiscard]] LevelSetFit {
  Points points;               ///< control points
  LevelSetError error;         ///< error of their limit
  std::vector<double> rounds;  ///< largest distance of the first guess, and after each round
};

/// Returns the fit of a cage.
/// @param surface  limit surface of the cage's mesh with its tags
/// @param rounds   number of rounds of projection and least squares
LevelSetFit fit_level_set(const LimitMap& surface, const Cage& cage, const FieldSides& sides, int rounds,
                          const std::function<void(int)>& progress = {});

/// Returns the error on a grid of N x N places per face. Normals are compared with the gradient of the face's
/// side.
/// @param curved  true: compare curvatures too
LevelSetError level_set_error(const LimitMap& surface, const Points& points, const Cage& cage, const FieldSides& sides,
                              int N = 7, bool curved = true);

}  // namespace sublimit
