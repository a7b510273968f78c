// SPDX-License-Identifier: Apache-2.0
#pragma once
// Closed sets of rows of a matrix: sets that depend on no rows outside, as a local matrix needs.
#include <utility>
#include <vector>

#include "sublimit/core/types.h"

namespace sublimit {

/// Returns the indices that the given rows depend on, themselves included, ascending.
/// @param open        the given rows
/// @param count       number of rows of the matrix
/// @param depends_on  depends_on(i, add) calls add(j) for all j that row i depends on
template <class DependsOn>
std::vector<Index> closed_set(std::vector<Index> open, Index count, const DependsOn& depends_on) {
  std::vector<bool> in(size_t(count), false);
  while (!open.empty()) {
    const Index i = open.back();
    open.pop_back();
    if (in[size_t(i)]) continue;
    in[size_t(i)] = true;
    depends_on(i, [&](Index j) { open.push_back(j); });
  }
  std::vector<Index> set;
  for (Index i = 0; i < count; ++i)
    if (in[size_t(i)]) set.push_back(i);
  return set;
}

/// Returns the smallest closed set of a dense matrix that contains the rows `open`: A(set, rest) = 0.
template <class Matrix>
std::vector<Index> closed_set(const Matrix& A, std::vector<Index> open) {
  using Number = typename Matrix::Scalar;
  return closed_set(std::move(open), static_cast<Index>(A.rows()), [&](Index i, const auto& add) {
    for (Index j = 0; j < A.cols(); ++j)
      if (A(i, j) != Number(0)) add(j);
  });
}

/// Returns the smallest closed set of a sparse matrix that contains the rows `open`.
template <class T>
std::vector<Index> closed_set(const Eigen::SparseMatrix<T, Eigen::RowMajor, Index>& A, std::vector<Index> open) {
  return closed_set(std::move(open), static_cast<Index>(A.rows()), [&](Index i, const auto& add) {
    for (typename Eigen::SparseMatrix<T, Eigen::RowMajor, Index>::InnerIterator it(A, i); it; ++it)
      if (it.value() != T(0)) add(static_cast<Index>(it.col()));
  });
}

}  // namespace sublimit
