// SPDX-License-Identifier: Apache-2.0
#include "sublimit/core/detail/left_eigenvector.h"

#include "sublimit/core/detail/dense_decompositions.h"

namespace sublimit {

std::optional<Eigen::VectorXd> left_eigenvector(const Eigen::MatrixXd& A, double value, const Eigen::VectorXd& scale) {
  const Eigen::Index size = A.rows();
  Eigen::MatrixXd equations(size + 1, size);
  equations.topRows(size) = A.transpose() - value * Eigen::MatrixXd::Identity(size, size);
  equations.row(size) = scale.transpose();
  const Eigen::VectorXd right = Eigen::VectorXd::Unit(size + 1, size);
  const PivotedQr qr(equations);
  using Wide = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>;
  Wide exact = equations.cast<long double>();
  exact.topRows(size) = A.transpose().cast<long double>() - value * Wide::Identity(size, size);
  Wide wide = Wide::Zero(size, 1);
  for (int step = 0; step < 4; ++step) {
    const Wide rest = right.cast<long double>() - exact * wide;
    wide += Eigen::MatrixXd(qr.solve(rest.cast<double>())).cast<long double>();
  }
  Eigen::VectorXd l = wide.cast<double>();
  if (qr.rank() < size || !((equations * l - right).norm() <= 1e-10)) return std::nullopt;
  return l;
}

}  // namespace sublimit
