// SPDX-License-Identifier: Apache-2.0
#pragma once
// Gauss quadrature on squares and triangles.
#include <vector>

namespace sublimit {

/// A node of a quadrature rule with its weight.
struct QuadraturePoint {
  double u = 0, v = 0, weight = 0;
};

/// Returns the product rule of n x n points on the unit square, exact for degrees up to 2n - 1 in u and in v.
/// Weights sum to 1.
std::vector<QuadraturePoint> square_rule(int n);
/// Returns the rule of n x n points on the triangle u, v >= 0, u + v <= 1, from the square with its side u = 1
/// collapsed to a point. Exact for total degrees up to 2n - 2. Weights sum to 1/2.
std::vector<QuadraturePoint> triangle_rule(int n);

}  // namespace sublimit
