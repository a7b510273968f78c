// SPDX-License-Identifier: Apache-2.0
#pragma once
// Decompositions of small complex matrices, made once: Eigen's are templates that take long to compile.
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
/// Finds singular values by Jacobi rotations: small ones keep their digits.
ComplexSingularValues singular_values(const Eigen::MatrixXcd& M);
/// Returns the last of them alone.
double smallest_singular_value(const Eigen::MatrixXcd& M);

/// LU of a square matrix, rows exchanged.
class ComplexLu {
 public:
  explicit ComplexLu(const Eigen::MatrixXcd& M);
  /// Returns M^-1 * right.
  Eigen::VectorXcd solve(const Eigen::VectorXcd& right) const;

 private:
  Eigen::PartialPivLU<Eigen::MatrixXcd> lu_;
};

/// Returns the x of least |M x - right|, by reflections with column pivoting.
Eigen::VectorXcd least_squares_solution(const Eigen::MatrixXcd& M, const Eigen::VectorXcd& right);

/// Returns M^-1 * right of a square matrix, by LU with rows and columns exchanged.
Eigen::MatrixXcd pivoted_solution(const Eigen::MatrixXcd& M, const Eigen::MatrixXcd& right);

}  // namespace sublimit
