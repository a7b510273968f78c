// SPDX-License-Identifier: Apache-2.0
#include "sublimit/analysis/dense_decompositions.h"

#include <Eigen/Eigenvalues>
#include <Eigen/SVD>

namespace sublimit {

SingularValues singular_values(const Eigen::MatrixXd& M) {
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(M, Eigen::ComputeFullV);
  return {svd.singularValues(), svd.matrixV()};
}

Eigen::VectorXcd eigenvalues(const Eigen::MatrixXd& M) {
  return Eigen::EigenSolver<Eigen::MatrixXd>(M, false).eigenvalues();
}

}  // namespace sublimit
