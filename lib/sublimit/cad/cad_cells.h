// SPDX-License-Identifier: Apache-2.0
#pragma once
// Parts of a limit on their way to four-sided patches.
#include <Eigen/Core>

#include <array>
#include <vector>

#include "sublimit/nets/piece_parts.h"

namespace sublimit {

/// Part of the surface, polynomial or not.
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

/// Returns the three or four corners of a cell, in parameters of its address.
std::vector<std::array<double, 2>> corners_in_address(const CadCell& cell);
/// Corners of the four-sided third of a triangle at one of its corners, counter-clockwise from there.
std::array<std::array<double, 2>, 4> third_of_triangle(const std::vector<std::array<double, 2>>& corners, size_t k);

/// Returns the values of the Bernstein polynomials of a degree.
Eigen::VectorXd bernstein_values(int degree, double t);
/// Returns interpolation nodes, symmetric and including both ends.
std::vector<double> interpolation_nodes(int degree);
/// Returns the matrix that makes Bernstein coefficients from values at the nodes.
Eigen::MatrixXd interpolation(int degree);

}  // namespace sublimit
