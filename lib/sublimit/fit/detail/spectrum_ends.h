// SPDX-License-Identifier: Apache-2.0
#pragma once
// The largest and the least singular values of a large sparse matrix B with at least as many rows as columns.
#include "sublimit/core/types.h"

namespace sublimit {

/// Returns the largest singular value, approximated from below by the Lanczos method on B^T B.
/// @param Bt  the transpose of B
double largest_singular_value(const SparseMatrix& B, const SparseMatrix& Bt);

/// Least singular values.
struct LeastSingular {
  Eigen::VectorXd values;  ///< ascending; upper bounds of the exact ones
  Points vectors;          ///< right singular vectors as orthonormal columns
};

/// Returns the least singular values, from block Krylov spaces of (B^T B + shift)^-1. B itself is decomposed on
/// these spaces, since squaring would lose values below 1e-8.
/// @param tiny  values up to this count as zero: more are computed while all found so far do, up to most + 1
/// @throws ResourceError  the factors of B^T B are larger than memory
LeastSingular least_singular(const SparseMatrix& B, const SparseMatrix& Bt, double tiny, Index most);

}  // namespace sublimit
