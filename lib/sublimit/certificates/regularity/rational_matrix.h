// SPDX-License-Identifier: Apache-2.0
#pragma once
// Matrices of ratios, and what FLINT decides about them exactly.
#include <Eigen/Core>

#include <vector>

#include "sublimit/certificates/regularity/rational_number.h"

namespace sublimit {

using RationalMatrix = Eigen::Matrix<Rational, Eigen::Dynamic, Eigen::Dynamic>;

/// Reduced row echelon form of M, in place.
/// @return  columns of the pivots, row by row
std::vector<Eigen::Index> reduce_rows(RationalMatrix& M);

/// @param M  square
bool is_singular(const RationalMatrix& M);

}  // namespace sublimit
