// SPDX-License-Identifier: Apache-2.0
#pragma once
// Parts of a limit that are converted to four-sided patches.
#include <Eigen/Core>

#include <array>
#include <vector>

#include "sublimit/nets/piece_parts.h"

namespace sublimit {

/// A part of the surface, polynomial or not.
struct CadCell {
  Index address = 0;
  CellCorners corners;
  int depth = 0;  ///< number of quarterings from a quadrilateral face, or a triangle
  bool triangle = false;
  int degree = 0;                   ///< degree of the polynomial; 0: none
  Points net = {};                  ///< Bernstein coefficients on the square, or the triangle
  const PieceType* type = nullptr;  ///< type of a part without a polynomial
  Points points = {};               ///< points that such a part depends on, by slot
};

/// Returns the three or four corners of a cell, in parameters of its address.
std::vector<std::array<double, 2>> corners_in_address(const CadCell& cell);
/// Returns the corners of the four-sided third of a triangle at corner k, counter-clockwise from there.
std::array<std::array<double, 2>, 4> third_of_triangle(const std::vector<std::array<double, 2>>& corners, size_t k);

/// Returns the values of all Bernstein polynomials of a degree at t.
Eigen::VectorXd bernstein_values(int degree, double t);
/// Returns interpolation nodes, symmetric and including both ends.
std::vector<double> interpolation_nodes(int degree);
/// Returns the matrix that makes Bernstein coefficients from values at the nodes.
Eigen::MatrixXd interpolation(int degree);

}  // namespace sublimit
