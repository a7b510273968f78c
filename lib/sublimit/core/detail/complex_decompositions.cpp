// SPDX-License-Identifier: Apache-2.0
#include "sublimit/core/detail/complex_decompositions.h"

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <Eigen/SVD>

#include "sublimit/base/error.h"

namespace sublimit {

Eigen::VectorXcd eigenvalues(const Eigen::MatrixXcd& M) {
  const Eigen::ComplexEigenSolver<Eigen::MatrixXcd> solver(M, false);
  if (solver.info() != Eigen::Success) throw AnalysisError("the eigenvalues of a complex matrix did not converge");
  return solver.eigenvalues();
}

ComplexSingularValues singular_values(const Eigen::MatrixXcd& M) {
  const Eigen::JacobiSVD<Eigen::MatrixXcd> svd(M, Eigen::ComputeFullV);
  return {svd.singularValues(), svd.matrixV()};
}

double smallest_singular_value(const Eigen::MatrixXcd& M) {
  return Eigen::JacobiSVD<Eigen::MatrixXcd>(M).singularValues().minCoeff();
}

ComplexLu::ComplexLu(const Eigen::MatrixXcd& M) : lu_(M) {}

Eigen::VectorXcd ComplexLu::solve(const Eigen::VectorXcd& right) const { return lu_.solve(right); }

Eigen::VectorXcd least_squares_solution(const Eigen::MatrixXcd& M, const Eigen::VectorXcd& right) {
  return Eigen::ColPivHouseholderQR<Eigen::MatrixXcd>(M).solve(right);
}

Eigen::MatrixXcd pivoted_solution(const Eigen::MatrixXcd& M, const Eigen::MatrixXcd& right) {
  return Eigen::FullPivLU<Eigen::MatrixXcd>(M).solve(right);
}

}  // namespace sublimit
