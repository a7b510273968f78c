// SPDX-License-Identifier: Apache-2.0
#include "sublimit/certificates/numbers/detail/ball_matrix.h"

namespace sublimit {

Eigen::MatrixXd BallMatrix::middle() const {
  Eigen::MatrixXd result(rows(), columns());
  for (Eigen::Index i = 0; i < rows(); ++i)
    for (Eigen::Index j = 0; j < columns(); ++j)
      result(i, j) = arf_get_d(arb_midref(arb_mat_entry(m_, i, j)), ARF_RND_NEAR);
  return result;
}

BallMatrix BallMatrix::transposed() const {
  BallMatrix result(columns(), rows());
  arb_mat_transpose(result.m_, m_);
  return result;
}

std::optional<BallMatrix> BallMatrix::inverse() const {
  BallMatrix result(rows(), rows());
  if (!arb_mat_inv(result.m_, m_, PrecisionScope::bits())) return std::nullopt;
  return result;
}

Ball BallMatrix::trace() const {
  Ball sum;
  arb_mat_trace(sum.get(), m_, PrecisionScope::bits());
  return sum;
}

BallMatrix operator*(const BallMatrix& a, const BallMatrix& b) {
  BallMatrix result(a.rows(), b.columns());
  arb_mat_mul(result.m_, a.m_, b.m_, PrecisionScope::bits());
  return result;
}

Ball maximum_norm(const BallMatrix& A) {
  Ball largest;
  for (Eigen::Index i = 0; i < A.rows(); ++i) {
    Ball sum;
    for (Eigen::Index j = 0; j < A.columns(); ++j) sum += abs(A(i, j));
    largest = max(largest, sum);
  }
  if (!largest.is_finite()) arb_zero_pm_inf(largest.get());
  return largest;
}

}  // namespace sublimit
