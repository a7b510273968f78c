// SPDX-License-Identifier: Apache-2.0
#pragma once
// Decompositions of small real matrices, made once: Eigen's are templates that take long to compile.
#include <Eigen/Core>

#include <complex>

namespace sublimit {

struct SingularValues {
  Eigen::VectorXd values;  ///< descending, min(rows, columns)
  Eigen::MatrixXd right;   ///< columns x columns, orthogonal: the right singular vectors, those without a value last
};
/// By Jacobi rotations: small values keep their digits.
SingularValues singular_values(const Eigen::MatrixXd& M);

/// Of a square matrix, in no order.
Eigen::VectorXcd eigenvalues(const Eigen::MatrixXd& M);

}  // namespace sublimit
