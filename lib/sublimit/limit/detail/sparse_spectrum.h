// SPDX-License-Identifier: Apache-2.0
#pragma once
// Spectra of sparse local matrices. Small ones use the dense decompositions of eigen_structure.h; large ones (a
// thousand faces between two creases) inverse iteration with sparse factors, in time proportional to the number
// of nonzeros.
#include "sublimit/core/types.h"
#include "sublimit/limit/detail/eigen_structure.h"

namespace sublimit {

/// Largest number of rows for dense decompositions, whose time grows with its cube.
inline constexpr Eigen::Index most_dense_rows = 256;

/// Returns the `count` largest clusters, by descending modulus. For large matrices, eigenvalues form a cluster
/// only if rounding cannot separate them, since those of sectors of many faces lie close together;
/// multiplicities above two may then be reported as two.
EigenStructure leading_clusters(const SparseMatrix& A, int count);

/// Returns the weights of the limit point: l^T A = l^T, sum l = 1.
/// @throws AnalysisError  eigenvalue 1 is not simple and dominant
Eigen::VectorXd limit_weights(const SparseMatrix& A);

/// Returns the minimum-norm solution of (A - mu) x = right; a least-squares solution if there is none.
Eigen::VectorXd shifted_solution(const SparseMatrix& A, double mu, const Eigen::VectorXd& right);

}  // namespace sublimit
