// SPDX-License-Identifier: Apache-2.0
#pragma once
// Distances from tangent planes as rows of least squares: three rows a place, across the surface and twice along it,
// over all coordinates of all control points, interleaved. Source: Pottmann, Leopoldseder 2003 (tangent distance
// minimisation).
#include "sublimit/fit/fit_problem.h"

namespace sublimit {

/// Sets A, b and weights of a problem in 3 n unknowns.
/// @param A           places x n, position rows
/// @param targets     places x 3
/// @param normals     places x 3, of length 1; zero: the distance is from the point
/// @param weights     of the squared distances
/// @param tangential  what the parts along the surface count
/// @throws ResourceError  more weights than 32-bit indices count
void add_tangent_rows(FitProblem& problem, const SparseMatrix& A, const Points& targets, const Points& normals,
                      const Eigen::VectorXd& weights, double tangential);

}  // namespace sublimit
