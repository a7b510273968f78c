// SPDX-License-Identifier: Apache-2.0
#pragma once
// Elimination in a field with exact equality.
#include <optional>
#include <utility>

#include "sublimit/certificates/algebraic.h"
#include "sublimit/neighborhood/local_matrix.h"

namespace sublimit {

/// Reduced row echelon form of M, in place.
/// @return  columns of the pivots, row by row
std::vector<Eigen::Index> reduce_rows(DenseMatrix<Algebraic>& M);

/// The one vector with M x = 0 and x_i = 1 for its last free component; nothing unless the kernel is a line.
std::optional<DenseMatrix<Algebraic>> kernel_line(DenseMatrix<Algebraic> M);

/// Returns the inverse of M, or nothing if it has none.
std::optional<DenseMatrix<Algebraic>> exact_inverse(const DenseMatrix<Algebraic>& M);

}  // namespace sublimit
