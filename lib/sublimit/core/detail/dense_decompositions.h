// SPDX-License-Identifier: Apache-2.0
#pragma once
// Decompositions of small matrices, compiled once: Eigen's templates take long to compile.
#include <Eigen/Core>
#include <Eigen/LU>
#include <Eigen/QR>

#include <complex>
#include <optional>

namespace sublimit {

struct SingularValues {
  Eigen::VectorXd values;  ///< descending, min(rows, columns)
  Eigen::MatrixXd right;   ///< columns x columns, orthogonal: the right singular vectors, those without a value last
};
/// Returns the singular values of M by Jacobi rotations: small values keep their relative accuracy.
SingularValues singular_values(const Eigen::MatrixXd& M);

/// Returns an orthonormal basis of the null space of a square matrix, as columns; nothing if its dimension is
/// not clear, which singular values can decide. A hundred times as fast as singular values.
std::optional<Eigen::MatrixXd> clear_null_space(const Eigen::MatrixXd& M);

/// Householder QR with column pivoting: least-squares solutions, and the rank.
class PivotedQr {
 public:
  explicit PivotedQr(const Eigen::MatrixXd& M);
  Eigen::Index rank() const;
  Eigen::MatrixXd solve(const Eigen::MatrixXd& right) const;
  /// Returns the last `count` columns of the orthogonal factor, which are orthogonal to the columns of a
  /// rank-deficient matrix.
  Eigen::MatrixXd last_directions(Eigen::Index count) const;

 private:
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr_;
};

/// Returns the minimum-norm least-squares solution. Pivots below `threshold` times the largest count as zero.
Eigen::VectorXd least_norm_solution(const Eigen::MatrixXd& M, const Eigen::VectorXd& right, double threshold);

/// Returns orthonormal columns with the same span as those of X.
Eigen::MatrixXd orthonormal_columns(const Eigen::MatrixXd& X);

/// Returns the triangular QR factor of a matrix with at least as many rows as columns.
Eigen::MatrixXd triangular_factor(const Eigen::MatrixXd& X);

/// Returns M^-1 * right of a square matrix, by LU with row pivoting.
Eigen::MatrixXd square_solution(const Eigen::MatrixXd& M, const Eigen::MatrixXd& right);
/// Returns M^-1 of a square matrix, by LU with row pivoting.
Eigen::MatrixXd inverse(const Eigen::MatrixXd& M);
/// Returns the determinant of a square matrix, by LU with row pivoting.
double determinant(const Eigen::MatrixXd& M);

/// LU decomposition with full pivoting, which decides whether there is an inverse.
class PivotedLu {
 public:
  explicit PivotedLu(const Eigen::MatrixXd& M);
  /// True if no pivot counts as zero.
  bool is_invertible() const;
  double rcond() const;  ///< estimate of 1 / condition number
  /// Returns M^-1 * right.
  Eigen::MatrixXd solve(const Eigen::MatrixXd& right) const;
  /// Returns M^-1.
  Eigen::MatrixXd inverse() const;

 private:
  Eigen::FullPivLU<Eigen::MatrixXd> lu_;
};

/// Returns the eigenvalues of a square matrix, in no order.
/// @throws AnalysisError  they do not converge
Eigen::VectorXcd eigenvalues(const Eigen::MatrixXd& M);

struct Eigenvectors {
  Eigen::VectorXcd values;   ///< in no order
  Eigen::MatrixXcd vectors;  ///< by columns
};
/// @throws AnalysisError  they do not converge
Eigenvectors eigenvectors(const Eigen::MatrixXd& M);

struct SymmetricEigenvectors {
  Eigen::VectorXd values;   ///< ascending
  Eigen::MatrixXd vectors;  ///< orthonormal columns
};
SymmetricEigenvectors symmetric_eigenvectors(const Eigen::MatrixXd& M);

/// Returns the eigenvalues of a symmetric matrix, ascending.
Eigen::VectorXd symmetric_eigenvalues(const Eigen::MatrixXd& M);

}  // namespace sublimit
