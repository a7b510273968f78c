// SPDX-License-Identifier: Apache-2.0
#pragma once
// Matrices of rational numbers, with exact decisions by FLINT.
#include <Eigen/Core>

#include <vector>

#include "sublimit/certificates/numbers/detail/rational_number.h"

namespace sublimit {

using RationalMatrix = Eigen::Matrix<Rational, Eigen::Dynamic, Eigen::Dynamic>;

/// Brings M to reduced row echelon form, in place.
/// @return  column of the pivot of each row
std::vector<Eigen::Index> reduce_rows(RationalMatrix& M);

/// True if a square matrix is singular.
bool is_singular(const RationalMatrix& M);

}  // namespace sublimit
