// SPDX-License-Identifier: Apache-2.0
#include "sublimit/analysis/dense_decompositions.h"

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <Eigen/SVD>

namespace sublimit {

SingularValues singular_values(const Eigen::MatrixXd& M) {
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(M, Eigen::ComputeFullV);
  return {svd.singularValues(), svd.matrixV()};
}

std::optional<Eigen::MatrixXd> clear_null_space(const Eigen::MatrixXd& M) {
  // Pivots fall, and follow the singular values within a factor of some hundreds.
  constexpr double surely_not_zero = 1e-6, surely_zero = 1e-12;
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(M.transpose());
  const Eigen::VectorXd pivots = qr.matrixQR().diagonal().cwiseAbs();
  if (pivots.size() == 0 || !(pivots[0] > 0)) return std::nullopt;
  Eigen::Index rank = 0;
  while (rank < pivots.size() && pivots[rank] > surely_not_zero * pivots[0]) ++rank;
  if (rank < pivots.size() && !(pivots[rank] < surely_zero * pivots[0])) return std::nullopt;
  const Eigen::MatrixXd Q = qr.householderQ();
  return Eigen::MatrixXd(Q.rightCols(pivots.size() - rank));
}

Eigen::VectorXcd eigenvalues(const Eigen::MatrixXd& M) {
  return Eigen::EigenSolver<Eigen::MatrixXd>(M, false).eigenvalues();
}

}  // namespace sublimit
