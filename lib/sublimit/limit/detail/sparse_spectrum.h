// SPDX-License-Identifier: Apache-2.0
#pragma once
// Spectra of sparse local matrices: small ones by dense decompositions, as eigen_structure.h has them; large ones (a
// thousand faces between two creases) by inverse iteration with sparse factors, in time that grows like the nonzeros.
#include "sublimit/core/types.h"
#include "sublimit/limit/detail/eigen_structure.h"

namespace sublimit {

/// Rows up to which a dense decomposition is taken: beyond, its work would grow like their cube.
inline constexpr Eigen::Index most_dense_rows = 256;

/// The `count` largest clusters, by descending modulus. Of large matrices, eigenvalues are one cluster only where
/// rounding cannot tell them apart: those of sectors of many faces lie close together. Multiplicities of more than two
/// may then be given as two.
EigenStructure leading_clusters(const SparseMatrix& A, int count);

/// Weights of the limit point: l^T A = l^T, sum l = 1.
/// @throws AnalysisError  eigenvalue 1 is not simple and dominant
Eigen::VectorXd limit_weights(const SparseMatrix& A);

/// Solution of (A - mu) x = right, of least norm if there are several. If there is none, one of least squares.
Eigen::VectorXd shifted_solution(const SparseMatrix& A, double mu, const Eigen::VectorXd& right);

}  // namespace sublimit
