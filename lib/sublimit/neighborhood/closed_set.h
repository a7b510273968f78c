// SPDX-License-Identifier: Apache-2.0
#pragma once
// What a local matrix needs: rows depend on other rows.
#include <vector>

#include "sublimit/core/types.h"

namespace sublimit {

/// Indices that the given rows depend on, themselves included: the smallest set with A(set, rest) = 0. Ascending.
template <class Matrix>
std::vector<Index> closed_set(const Matrix& A, std::vector<Index> open) {
  using Number = typename Matrix::Scalar;
  std::vector<bool> in(A.rows(), false);
  while (!open.empty()) {
    const Index i = open.back();
    open.pop_back();
    if (in[i]) continue;
    in[i] = true;
    for (Index j = 0; j < A.cols(); ++j)
      if (A(i, j) != Number(0)) open.push_back(j);
  }
  std::vector<Index> set;
  for (Index i = 0; i < A.rows(); ++i)
    if (in[i]) set.push_back(i);
  return set;
}

}  // namespace sublimit
