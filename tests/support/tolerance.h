// SPDX-License-Identifier: Apache-2.0
#pragma once
// Tolerances with a cause and a name. Exact things are compared with EXPECT_EQ.
#include <cmath>
#include <limits>

#include "sublimit/core/types.h"

namespace sublimit::testing {

inline constexpr double eps = std::numeric_limits<double>::epsilon();

/// Tolerance of sums of m terms of size `magnitude` (sum |w| * max |x|). Products of k levels: m = 4 k.
inline double rounding(double terms, double magnitude = 1) { return 4 * terms * eps * magnitude; }

/// Tolerance of simple eigenvalues and eigenvectors of conditioning kappa.
inline double eigen(double kappa = 1) { return 100 * eps * kappa; }

/// Agreement with a reference that computes the same sums in another order, relative to the bounding box.
inline constexpr double reference = 1e-13;
/// Angles between normals, radians: cross products of tangents that are exact to a few ulps.
inline constexpr double reference_angle = 1e-9;
/// Derivatives of limits against the truth, relative to their own size, as near as 2^-40 to extraordinary vertices:
/// what lib/README.md promises.
inline constexpr double first_derivative = 1e-11, second_derivative = 1e-9;

/// Equal weights of hundreds of terms that are computed in another way: from another face, by eigenvectors
/// instead of blocks.
inline constexpr double other_route = 1e-12;
/// Second derivatives of size 10 as a program prints them, absolute, from rotated faces.
inline constexpr double printed_derivative = 1e-10;
/// Tables in float against the same in double, relative to the bounding box.
inline constexpr double float_reference = 1e-6;

/// Closed forms that texts print with seven digits, and tables of eight decimals: half of the last one, and rounding.
inline constexpr double seven_digits = 1e-6, eight_decimals = 5.01e-9;
/// Third derivatives of polynomial pieces from differences of their control points, relative to the second ones.
inline constexpr double third_derivative = 1e-9;

/// Fits to points of a known surface, relative to its size, iterated until the energy stops decreasing:
/// distances, and control points, some of which hardly affect the distances.
inline constexpr double found_again = 1e-10, found_control_points = 1e-7;

/// Distances and parameters of rays, relative to the size of the surface: the accuracy of the search, which is
/// multiplied for oblique rays.
inline constexpr double found_hit = 1e-10;
/// These at slopes down to 1e-5, by which rounding errors of the coordinates are divided.
inline constexpr double found_grazing = 1e-9;
/// Positions where a ray touches a surface of size 1: the square root of the distance that the search resolves.
inline constexpr double found_touch = 1e-5;
/// Distances from a search with the accuracy 1e-12 of the surface's size.
inline constexpr double found_distance = 1e-12;

/// Exact faces of CAD models, relative to the size of the surface: nets of B-splines are sums of a few products.
inline constexpr double cad_exact = 1e-12;

inline double diagonal(const Points& points) {
  if (points.rows() == 0) return 0;
  return (points.colwise().maxCoeff() - points.colwise().minCoeff()).norm();
}

}  // namespace sublimit::testing
