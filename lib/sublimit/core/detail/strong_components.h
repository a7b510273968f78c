// SPDX-License-Identifier: Apache-2.0
#pragma once
// Strongly connected components of a sparsity pattern: the diagonal blocks of a matrix's block triangular form, whose
// eigenvalues are those of the matrix.
#include <vector>

#include "sublimit/core/types.h"

namespace sublimit {

/// Returns the strongly connected components of a matrix's rows, each ascending.
/// @param columns  columns of the nonzeros of each row, in any order, repeated or not
std::vector<std::vector<Index>> strong_components(const std::vector<std::vector<Index>>& columns);

}  // namespace sublimit
