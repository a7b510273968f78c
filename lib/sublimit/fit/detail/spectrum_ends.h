// SPDX-License-Identifier: Apache-2.0
#pragma once
// The ends of the singular values of a large sparse matrix B with at least as many rows as columns.
#include "sublimit/core/types.h"

namespace sublimit {

/// Returns the largest singular value, approached from below by Lanczos' method on B^T B.
/// @param Bt  the transpose of B
double largest_singular_value(const SparseMatrix& B, const SparseMatrix& Bt);

struct LeastSingular {
  Eigen::VectorXd values;  ///< ascending, each an upper bound of the one in its place
  Points vectors;          ///< right ones, as columns, orthonormal
};

/// Block Krylov spaces of (B^T B + shift)^-1, on which B itself is decomposed: squares lose the digits of values below
/// 1e-8, but the spaces do not.
/// @param tiny  values up to this vanish: more are looked for while all that were found do, up to most + 1 of them
/// @throws ResourceError  the factors of B^T B are larger than memory
LeastSingular least_singular(const SparseMatrix& B, const SparseMatrix& Bt, double tiny, Index most);

}  // namespace sublimit
