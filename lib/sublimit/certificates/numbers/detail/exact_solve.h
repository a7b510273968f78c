// SPDX-License-Identifier: Apache-2.0
#pragma once
// Elimination in a field with exact equality.
#include <optional>
#include <utility>

#include "sublimit/certificates/numbers/algebraic.h"
#include "sublimit/neighborhood/local_matrix.h"

namespace sublimit {

/// Brings M to reduced row echelon form, in place.
/// @return  column of the pivot of each row
std::vector<Eigen::Index> reduce_rows(DenseMatrix<Algebraic>& M);

/// Returns the vector with M x = 0 whose last free component is 1; nothing unless the kernel has dimension 1.
std::optional<DenseMatrix<Algebraic>> kernel_line(DenseMatrix<Algebraic> M);

/// Returns the inverse of M, or nothing if it has none.
std::optional<DenseMatrix<Algebraic>> exact_inverse(const DenseMatrix<Algebraic>& M);

}  // namespace sublimit
