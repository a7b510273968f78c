// SPDX-License-Identifier: Apache-2.0
#include "sublimit/core/detail/sparse_rows.h"

#include <algorithm>
#include <limits>

#include "sublimit/base/detail/parallel_for.h"
#include "sublimit/base/error.h"
#include "sublimit/core/uninitialized.h"

namespace sublimit {

namespace {

SparseMatrix sized(std::int64_t rows, Index columns, std::int64_t nonzeros) {
  if (nonzeros > std::numeric_limits<Index>::max())
    throw ResourceError("sparse rows: more nonzeros than 32-bit indices count");
  SparseMatrix M(rows, columns);
  resize_nonzeros(M, nonzeros);
  M.outerIndexPtr()[0] = 0;
  return M;
}

}  // namespace

SparseMatrix matrix_of(std::span<const SparseRows::Row> rows, Index columns) {
  std::int64_t nonzeros = 0;
  for (const SparseRows::Row row : rows) nonzeros += std::ssize(row);
  SparseMatrix M = sized(std::ssize(rows), columns, nonzeros);
  Index* const start = M.outerIndexPtr();
  for (size_t r = 0; r < rows.size(); ++r) start[r + 1] = start[r] + static_cast<Index>(rows[r].size());
  parallel_for(std::ssize(rows), [&](std::int64_t r) {
    Index at = start[r];
    for (const auto& [column, weight] : rows[static_cast<size_t>(r)]) {
      M.innerIndexPtr()[at] = column;
      M.valuePtr()[at++] = weight;
    }
  });
  return M;
}

SparseMatrix StackedRows::matrix(Index columns) && {
  SparseMatrix M;
  if (blocks_.size() == 1) {
    M.swap(blocks_[0]);
    return M;
  }
  std::int64_t rows = 0, nonzeros = 0;
  for (const SparseMatrix& block : blocks_) rows += block.rows(), nonzeros += block.nonZeros();
  sized(rows, columns, nonzeros).swap(M);
  Index* start = M.outerIndexPtr();
  for (; !blocks_.empty(); blocks_.pop_front()) {
    const SparseMatrix& block = blocks_.front();
    const Index first = *start;
    parallel_for_blocks(
        block.nonZeros(),
        [&](std::int64_t, std::int64_t begin, std::int64_t end) {
          std::copy(block.innerIndexPtr() + begin, block.innerIndexPtr() + end, M.innerIndexPtr() + first + begin);
          std::copy(block.valuePtr() + begin, block.valuePtr() + end, M.valuePtr() + first + begin);
        },
        1 << 18);
    for (Eigen::Index r = 1; r <= block.rows(); ++r) start[r] = first + block.outerIndexPtr()[r];
    start += block.rows();
  }
  return M;
}

}  // namespace sublimit
