// SPDX-License-Identifier: Apache-2.0
#pragma once
// Gauss quadrature on squares and triangles.
#include <vector>

namespace sublimit {

struct QuadraturePoint {
  double u = 0, v = 0, weight = 0;
};

/// Product rule of n x n points on the unit square, exact for degrees up to 2n - 1 in u and in v. Weights sum to 1.
std::vector<QuadraturePoint> square_rule(int n);
/// Returns the rule on the triangle u, v >= 0, u + v <= 1, a square whose side u = 1 is collapsed to a point: exact for
/// total degrees up to 2n - 2.
/// Weights sum to 1/2.
std::vector<QuadraturePoint> triangle_rule(int n);

}  // namespace sublimit
