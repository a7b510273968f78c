// SPDX-License-Identifier: Apache-2.0
#pragma once
// Decompositions of small complex matrices, made once: Eigen's are templates that take long to compile.
#include <Eigen/Core>
#include <Eigen/LU>

#include <optional>

namespace sublimit {

/// Of a square matrix, in no order; nothing where they do not converge.
std::optional<Eigen::VectorXcd> eigenvalues(const Eigen::MatrixXcd& M);

struct ComplexSingularValues {
  Eigen::VectorXd values;  ///< descending, min(rows, columns)
  Eigen::MatrixXcd right;  ///< columns x columns, unitary: the right singular vectors, those without a value last
};
/// By Jacobi rotations: small values keep their digits.
ComplexSingularValues singular_values(const Eigen::MatrixXcd& M);
/// The last of them alone.
double smallest_singular_value(const Eigen::MatrixXcd& M);

/// LU of a square matrix, rows exchanged.
class ComplexLu {
 public:
  explicit ComplexLu(const Eigen::MatrixXcd& M);
  /// M^-1 * right.
  Eigen::VectorXcd solve(const Eigen::VectorXcd& right) const;

 private:
  Eigen::PartialPivLU<Eigen::MatrixXcd> lu_;
};

/// Of least squares, by reflections with column pivoting.
Eigen::VectorXcd least_squares_solution(const Eigen::MatrixXcd& M, const Eigen::VectorXcd& right);

/// M^-1 * right of a square matrix, rows and columns exchanged.
Eigen::MatrixXcd pivoted_solution(const Eigen::MatrixXcd& M, const Eigen::MatrixXcd& right);

}  // namespace sublimit
