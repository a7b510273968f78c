// SPDX-License-Identifier: Apache-2.0
#include "sublimit/core/detail/submatrix.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace sublimit {

SparseMatrix submatrix(const SparseMatrix& A, std::span<const Index> rows, std::span<const Index> columns) {
  std::vector<Index> place(static_cast<size_t>(A.cols()), -1);
  for (size_t i = 0; i < columns.size(); ++i) place[static_cast<size_t>(columns[i])] = static_cast<Index>(i);
  SparseMatrix result(static_cast<Index>(rows.size()), static_cast<Index>(columns.size()));
  std::vector<std::pair<Index, double>> row;
  for (size_t i = 0; i < rows.size(); ++i) {
    row.clear();
    for (SparseMatrix::InnerIterator it(A, rows[i]); it; ++it)
      if (const Index at = place[static_cast<size_t>(it.col())]; at >= 0) row.emplace_back(at, it.value());
    std::sort(row.begin(), row.end());
    result.startVec(static_cast<Index>(i));
    for (const auto& [column, weight] : row) result.insertBack(static_cast<Index>(i), column) = weight;
  }
  result.finalize();
  return result;
}

bool has_same_bits(const SparseMatrix& a, const SparseMatrix& b) {
  return a.rows() == b.rows() && a.cols() == b.cols() && a.nonZeros() == b.nonZeros() &&
         std::equal(a.outerIndexPtr(), a.outerIndexPtr() + a.rows() + 1, b.outerIndexPtr()) &&
         std::equal(a.innerIndexPtr(), a.innerIndexPtr() + a.nonZeros(), b.innerIndexPtr()) &&
         std::equal(a.valuePtr(), a.valuePtr() + a.nonZeros(), b.valuePtr());
}

}  // namespace sublimit
