// SPDX-License-Identifier: Apache-2.0
#pragma once
// Sparse matrices as Matrix Market text (coordinate real general, 1-based), read by SciPy, MATLAB, Julia.
#include <filesystem>

#include "sublimit/core/types.h"
#include "sublimit/eval/table/stencil_table.h"

namespace sublimit {

/// Writes a matrix. Numbers have the shortest form that reads back to the same bits; floats that of a float.
/// @throws IoError  unwritable;  ResourceError  a full disk
void write_matrix_market(const std::filesystem::path& path, const SparseMatrix& matrix);
template <class Real>
void write_matrix_market(const std::filesystem::path& path, const StencilTable<Real>& table);

}  // namespace sublimit
