// SPDX-License-Identifier: Apache-2.0
#pragma once
// Submatrices of sparse matrices, and their comparison.
#include <span>

#include "sublimit/core/types.h"

namespace sublimit {

/// Returns the entries of some rows in some columns, numbered by their positions in these lists.
/// @param columns  each at most once
SparseMatrix submatrix(const SparseMatrix& A, std::span<const Index> rows, std::span<const Index> columns);

/// True if two matrices have the same shape and the same entries, to the last bit.
bool has_same_bits(const SparseMatrix& a, const SparseMatrix& b);

}  // namespace sublimit
