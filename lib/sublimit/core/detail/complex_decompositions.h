// SPDX-License-Identifier: Apache-2.0
#pragma once
// Decompositions of small complex matrices, compiled once: Eigen's templates take long to compile.
#include <Eigen/Core>
#include <Eigen/LU>

namespace sublimit {

/// Returns the eigenvalues of a square matrix, in no order.
/// @throws AnalysisError  they do not converge
Eigen::VectorXcd eigenvalues(const Eigen::MatrixXcd& M);

struct ComplexSingularValues {
  Eigen::VectorXd values;  ///< descending, min(rows, columns)
  Eigen::MatrixXcd right;  ///< columns x columns, unitary: the right singular vectors, those without a value last
};
/// Returns singular values by Jacobi rotations: small values keep their relative accuracy.
ComplexSingularValues singular_values(const Eigen::MatrixXcd& M);
/// Returns the least singular value.
double smallest_singular_value(const Eigen::MatrixXcd& M);

/// LU decomposition of a square matrix with row pivoting.
class ComplexLu {
 public:
  explicit ComplexLu(const Eigen::MatrixXcd& M);
  /// Returns M^-1 * right.
  Eigen::VectorXcd solve(const Eigen::VectorXcd& right) const;

 private:
  Eigen::PartialPivLU<Eigen::MatrixXcd> lu_;
};

/// Returns the x that minimises |M x - right|, by Householder QR with column pivoting.
Eigen::VectorXcd least_squares_solution(const Eigen::MatrixXcd& M, const Eigen::VectorXcd& right);

/// Returns M^-1 * right of a square matrix, by LU with full pivoting.
Eigen::MatrixXcd pivoted_solution(const Eigen::MatrixXcd& M, const Eigen::MatrixXcd& right);

}  // namespace sublimit
