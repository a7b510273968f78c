// SPDX-License-Identifier: Apache-2.0
#pragma once
// The blossom of a triangular Bezier patch. Its values are points, derivatives, and control points of parts of
// the patch.
// Source: Ramshaw 1989, "Blossoms are polar forms".
#include <array>
#include <span>
#include <vector>

namespace sublimit {

/// Barycentric coordinates of a point (sum 1) or of a direction (sum 0).
using Barycentric = std::array<double, 3>;

/// Returns the weights of the blossom f(x_1 .. x_n) over the control points b_ijk, i + j + k = n, in the order
/// (n-j-k, j, k), j fastest.
std::vector<double> triangle_blossom(std::span<const Barycentric> arguments);

}  // namespace sublimit
