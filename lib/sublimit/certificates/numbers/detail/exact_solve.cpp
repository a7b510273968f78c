// SPDX-License-Identifier: Apache-2.0
#include "sublimit/certificates/numbers/detail/exact_solve.h"

namespace sublimit {

std::vector<Eigen::Index> reduce_rows(DenseMatrix<Algebraic>& M) {
  std::vector<Eigen::Index> pivots;
  for (Eigen::Index column = 0; column < M.cols(); ++column) {
    const auto row = static_cast<Eigen::Index>(pivots.size());
    Eigen::Index with = row;
    while (with < M.rows() && M(with, column).is_zero()) ++with;
    if (with == M.rows()) continue;
    if (with != row) M.row(row).swap(M.row(with));
    const Algebraic scale = M(row, column).inverse();
    for (Eigen::Index j = column; j < M.cols(); ++j)
      if (!M(row, j).is_zero()) M(row, j) *= scale;
    for (Eigen::Index i = 0; i < M.rows(); ++i) {
      if (i == row || M(i, column).is_zero()) continue;
      const Algebraic factor = M(i, column);
      for (Eigen::Index j = column; j < M.cols(); ++j)
        if (!M(row, j).is_zero()) M(i, j) -= factor * M(row, j);
    }
    pivots.push_back(column);
  }
  return pivots;
}

std::optional<DenseMatrix<Algebraic>> kernel_line(DenseMatrix<Algebraic> M) {
  const std::vector<Eigen::Index> pivots = reduce_rows(M);
  if (static_cast<Eigen::Index>(pivots.size()) + 1 != M.cols()) return std::nullopt;
  Eigen::Index free = 0;
  while (free < static_cast<Eigen::Index>(pivots.size()) && pivots[static_cast<size_t>(free)] == free) ++free;
  DenseMatrix<Algebraic> x(M.cols(), 1);
  x(free, 0) = Algebraic(1);
  for (size_t row = 0; row < pivots.size(); ++row) x(pivots[row], 0) = -M(static_cast<Eigen::Index>(row), free);
  return x;
}

std::optional<DenseMatrix<Algebraic>> exact_inverse(const DenseMatrix<Algebraic>& M) {
  const Eigen::Index n = M.rows();
  DenseMatrix<Algebraic> both(n, 2 * n);
  both.leftCols(n) = M;
  for (Eigen::Index i = 0; i < n; ++i) both(i, n + i) = Algebraic(1);
  const std::vector<Eigen::Index> pivots = reduce_rows(both);
  if (pivots.empty() || pivots.back() != n - 1 || static_cast<Eigen::Index>(pivots.size()) != n) return std::nullopt;
  return both.rightCols(n);
}

}  // namespace sublimit
