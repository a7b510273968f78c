// SPDX-License-Identifier: Apache-2.0
#pragma once
// Parts of a limit on their way to four-sided patches.
#include <Eigen/Core>

#include <array>
#include <vector>

#include "sublimit/limit/piece_parts.h"

namespace sublimit {

/// Part of the surface: a polynomial, or what is not known to be one.
struct CadCell {
  Index address = 0;
  CellCorners corners;
  int depth = 0;  ///< quarterings of a quadrilateral face, or of a triangle
  bool triangle = false;
  int degree = 0;   ///< 0: no polynomial
  Points net = {};  ///< on the square, or the triangle
  const PieceType* type = nullptr;
  Points points = {};
};

/// Three or four, in its address.
std::vector<std::array<double, 2>> corners_in_address(const CadCell& cell);
/// Corners of the four-sided third of a triangle at one of its corners, counter-clockwise from there.
std::array<std::array<double, 2>, 4> third_of_triangle(const std::vector<std::array<double, 2>>& corners, size_t k);

/// Values of the Bernstein polynomials of a degree.
Eigen::VectorXd bernstein_values(int degree, double t);
/// Nodes with the ends, symmetric.
std::vector<double> interpolation_nodes(int degree);
/// Bernstein coefficients by values at the nodes.
Eigen::MatrixXd interpolation(int degree);

}  // namespace sublimit
