// SPDX-License-Identifier: Apache-2.0
#pragma once
// Decompositions of small real matrices, made once: Eigen's are templates that take long to compile.
#include <Eigen/Core>

#include <complex>
#include <optional>

namespace sublimit {

struct SingularValues {
  Eigen::VectorXd values;  ///< descending, min(rows, columns)
  Eigen::MatrixXd right;   ///< columns x columns, orthogonal: the right singular vectors, those without a value last
};
/// By Jacobi rotations: small values keep their digits.
SingularValues singular_values(const Eigen::MatrixXd& M);

/// Orthonormal basis of the vectors that a square matrix takes to zero, by columns; nothing where it is in doubt how
/// many there are, which singular values decide. A hundred times as fast as these.
std::optional<Eigen::MatrixXd> clear_null_space(const Eigen::MatrixXd& M);

/// Of a square matrix, in no order.
Eigen::VectorXcd eigenvalues(const Eigen::MatrixXd& M);

}  // namespace sublimit
