// SPDX-License-Identifier: Apache-2.0
#pragma once
// Distances from tangent planes as rows of least squares: three rows per place, one normal to the surface and
// two tangential, over all coordinates of all control points, interleaved. Source: Pottmann, Leopoldseder 2003
// (tangent distance minimisation).
#include "sublimit/fit/fit_problem.h"

namespace sublimit {

/// Sets A, b and weights of a problem in 3 n unknowns.
/// @param A           position rows, #places x n
/// @param targets     #places x 3
/// @param normals     #places x 3, unit length; zero: the distance from the point is used
/// @param weights     weights of the squared distances
/// @param tangential  factor of the tangential components
/// @throws ResourceError  more weights than 32-bit indices count
void add_tangent_rows(FitProblem& problem, const SparseMatrix& A, const Points& targets, const Points& normals,
                      const Eigen::VectorXd& weights, double tangential);

}  // namespace sublimit
