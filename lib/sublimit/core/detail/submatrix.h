// SPDX-License-Identifier: Apache-2.0
#pragma once
// Submatrices of sparse matrices.
#include <span>

#include "sublimit/core/types.h"

namespace sublimit {

/// Returns the entries of some rows in some columns, numbered by their positions in these lists.
/// @param columns  each at most once
SparseMatrix submatrix(const SparseMatrix& A, std::span<const Index> rows, std::span<const Index> columns);

}  // namespace sublimit
