// SPDX-License-Identifier: Apache-2.0
#pragma once
// Sparse matrices as Matrix Market text (coordinate real general, 1-based), read by SciPy, MATLAB, Julia.
#include <filesystem>

#include "sublimit/types.h"

namespace sublimit {

/// @throws IoError  unwritable;  ResourceError  a full disk
void write_matrix_market(const std::filesystem::path& path, const SparseMatrix& matrix);

}  // namespace sublimit
