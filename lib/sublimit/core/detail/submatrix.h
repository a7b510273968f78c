// SPDX-License-Identifier: Apache-2.0
#pragma once
// Rows and columns of a sparse matrix as a matrix of their own.
#include <span>

#include "sublimit/core/types.h"

namespace sublimit {

/// The entries of `rows` in `columns`, numbered by their places in these lists.
/// @param columns  each at most once
SparseMatrix submatrix(const SparseMatrix& A, std::span<const Index> rows, std::span<const Index> columns);

}  // namespace sublimit
