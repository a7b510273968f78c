// SPDX-License-Identifier: Apache-2.0
#include "sublimit/core/sparse_rows.h"

#include <algorithm>
#include <limits>

#include "sublimit/base/error.h"
#include "sublimit/base/parallel_for.h"
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

SparseMatrix stacked(std::vector<SparseMatrix> blocks, Index columns) {
  if (blocks.size() == 1) return std::move(blocks[0]);
  std::int64_t rows = 0, nonzeros = 0;
  for (const SparseMatrix& block : blocks) rows += block.rows(), nonzeros += block.nonZeros();
  SparseMatrix M = sized(rows, columns, nonzeros);
  Index* start = M.outerIndexPtr();
  for (SparseMatrix& block : blocks) {
    const Index first = *start;
    std::copy_n(block.innerIndexPtr(), block.nonZeros(), M.innerIndexPtr() + first);
    std::copy_n(block.valuePtr(), block.nonZeros(), M.valuePtr() + first);
    for (Eigen::Index r = 1; r <= block.rows(); ++r) start[r] = first + block.outerIndexPtr()[r];
    start += block.rows();
    block = SparseMatrix();
  }
  return M;
}

}  // namespace sublimit
