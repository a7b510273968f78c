// SPDX-License-Identifier: Apache-2.0
#include "sublimit/certificates/regularity/rational_matrix.h"

#include <flint/fmpq_mat.h>

#include "sublimit/certificates/numbers/detail/flint_value.h"

namespace sublimit {
namespace {

/// The same matrix as FLINT stores it.
struct FlintMatrix {
  fmpq_mat_t m;
  explicit FlintMatrix(const RationalMatrix& M) {
    fmpq_mat_init(m, M.rows(), M.cols());
    for (Eigen::Index i = 0; i < M.rows(); ++i)
      for (Eigen::Index j = 0; j < M.cols(); ++j) fmpq_set(fmpq_mat_entry(m, i, j), M(i, j).get());
  }
  FlintMatrix(const FlintMatrix&) = delete;
  FlintMatrix& operator=(const FlintMatrix&) = delete;
  ~FlintMatrix() { fmpq_mat_clear(m); }
};

}  // namespace

std::vector<Eigen::Index> reduce_rows(RationalMatrix& M) {
  FlintMatrix rows(M);
  std::vector<Eigen::Index> pivots(static_cast<size_t>(fmpq_mat_rref(rows.m, rows.m)));
  for (Eigen::Index i = 0; i < M.rows(); ++i)
    for (Eigen::Index j = 0; j < M.cols(); ++j) M(i, j) = Rational(fmpq_mat_entry(rows.m, i, j));
  Eigen::Index row = 0, column = 0;
  for (Eigen::Index& pivot : pivots) {
    while (M(row, column).is_zero()) ++column;
    pivot = column;
    ++row;
  }
  return pivots;
}

bool is_singular(const RationalMatrix& M) {
  const FlintMatrix square(M);
  FlintRatio determinant;
  fmpq_mat_det(determinant, square.m);
  return fmpq_is_zero(determinant);
}

}  // namespace sublimit
