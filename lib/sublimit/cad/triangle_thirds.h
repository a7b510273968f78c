// SPDX-License-Identifier: Apache-2.0
#pragma once
// A triangular Bezier patch as three tensor patches of the same degree in both directions, which meet in its middle.
#include <Eigen/Core>

#include <array>

namespace sublimit {

/// The nets of the thirds at the corners (0,0), (1,0), (0,1) from that of the triangle: (n + 1)^2 x (n + 1)(n + 2)/2,
/// the first parameter fastest, the triangle's points in the order of `TrianglePatch`. Rows have no negative entry and
/// sum to 1.
///
/// A third is the bilinear image of the square, P(s,t) = (1 - t) A(s) + t B(s). Its control points are sums of values
/// of the triangle's blossom at n of the corners of the third, by the products of Bernstein polynomials in s.
std::array<Eigen::MatrixXd, 3> triangle_thirds(int degree);

}  // namespace sublimit
