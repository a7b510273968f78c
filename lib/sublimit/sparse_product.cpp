// SPDX-License-Identifier: Apache-2.0
#include "sublimit/sparse_product.h"

#include <tbb/enumerable_thread_specific.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <string>
#include <vector>

#include "sublimit/base/error.h"
#include "sublimit/base/parallel_for.h"
#include "sublimit/uninitialized.h"

namespace sublimit {
namespace {

std::string shape(Index rows, Index columns) { return std::to_string(rows) + " x " + std::to_string(columns); }

template <int Channels>
void apply_rows(const SparseMatrix& S, const double* in, double* out, std::int64_t begin, std::int64_t end) {
  for (std::int64_t r = begin; r < end; ++r) {
    double sum[Channels] = {};
    for (Index k = S.outerIndexPtr()[r]; k < S.outerIndexPtr()[r + 1]; ++k) {
      const double w = S.valuePtr()[k];
      const double* x = in + std::int64_t{S.innerIndexPtr()[k]} * Channels;
      for (int c = 0; c < Channels; ++c) sum[c] += w * x[c];
    }
    std::copy_n(sum, Channels, out + r * Channels);
  }
}

/// One row of A * B at a time. Sums stand in a dense array beside the row that last touched them. The rows of B are sorted,
/// and neighbours share most columns: only what a row adds to those before it is put in order and merged.
class RowProduct {
 public:
  RowProduct(const SparseMatrix& A, const SparseMatrix& B) : A_(A), B_(B), cells_(B.cols(), Cell{0, -1}) {}

  /// Appends the row's columns, ascending, and their values.
  void append(Index r, std::vector<Index>& columns, std::vector<double>& values) {
    row_.clear();
    for (Index i = A_.outerIndexPtr()[r]; i < A_.outerIndexPtr()[r + 1]; ++i) {
      const Index row = A_.innerIndexPtr()[i], begin = B_.outerIndexPtr()[row], end = B_.outerIndexPtr()[row + 1];
      const double w = A_.valuePtr()[i];
      const size_t known = row_.size();
      for (Index k = begin; k < end; ++k) {
        const Index c = B_.innerIndexPtr()[k];
        Cell& cell = cells_[c];
        if (cell.row == r) {
          cell.sum += w * B_.valuePtr()[k];
        } else {
          cell = {w * B_.valuePtr()[k], r};
          row_.push_back(c);
        }
      }
      if (known > 0 && row_.size() > known && row_[known] < row_[known - 1]) {
        merged_.resize(row_.size());
        std::merge(row_.begin(), row_.begin() + Eigen::Index(known), row_.begin() + Eigen::Index(known), row_.end(),
                   merged_.begin());
        row_.swap(merged_);
      }
    }
    const size_t at = columns.size();
    columns.resize(at + row_.size());
    values.resize(at + row_.size());
    for (size_t k = 0; k < row_.size(); ++k) {
      columns[at + k] = row_[k];
      values[at + k] = cells_[row_[k]].sum;
    }
  }

 private:
  struct Cell {
    double sum;
    Index row;
  };
  const SparseMatrix& A_;
  const SparseMatrix& B_;
  std::vector<Cell> cells_;
  std::vector<Index> row_, merged_;
};

}  // namespace

Points apply(const SparseMatrix& S, const Points& points) {
  if (points.rows() != S.cols())
    throw InvalidParameter("a matrix of " + shape(Index(S.rows()), Index(S.cols())) + " needs " +
                           std::to_string(S.cols()) + " points, not " + std::to_string(points.rows()));
  Points result(S.rows(), points.cols());
  const Index channels = static_cast<Index>(points.cols());
  parallel_for_blocks(S.rows(), [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    if (channels == 3) return apply_rows<3>(S, points.data(), result.data(), begin, end);
    for (std::int64_t r = begin; r < end; ++r) {
      result.row(r).setZero();
      for (Index k = S.outerIndexPtr()[r]; k < S.outerIndexPtr()[r + 1]; ++k)
        result.row(r) += S.valuePtr()[k] * points.row(S.innerIndexPtr()[k]);
    }
  });
  return result;
}

SparseMatrix product(const SparseMatrix& A, const SparseMatrix& B) {
  if (A.cols() != B.rows())
    throw InvalidParameter("cannot multiply matrices of " + shape(Index(A.rows()), Index(A.cols())) + " and " +
                           shape(Index(B.rows()), Index(B.cols())));
  struct Block {  // exactly as large as its rows
    UninitializedVector<Index> columns;
    UninitializedVector<double> values;
  };
  struct Worker {
    RowProduct rows;
    std::vector<Index> columns;
    std::vector<double> values;
  };
  std::vector<Block> blocks(num_blocks(A.rows()));
  SparseMatrix P(A.rows(), B.cols());
  Index* const outer = P.outerIndexPtr();
  tbb::enumerable_thread_specific<Worker> workers([&] { return Worker{RowProduct(A, B), {}, {}}; });
  parallel_for_blocks(A.rows(), [&](std::int64_t block, std::int64_t begin, std::int64_t end) {
    Worker& worker = workers.local();
    worker.columns.clear();
    worker.values.clear();
    for (std::int64_t r = begin; r < end; ++r) {
      outer[r] = static_cast<Index>(worker.columns.size());  // within the block, at first
      worker.rows.append(static_cast<Index>(r), worker.columns, worker.values);
    }
    blocks[block].columns.assign(worker.columns.begin(), worker.columns.end());
    blocks[block].values.assign(worker.values.begin(), worker.values.end());
  });
  std::vector<std::int64_t> start(blocks.size() + 1, 0);
  for (size_t b = 0; b < blocks.size(); ++b) start[b + 1] = start[b] + std::int64_t(blocks[b].columns.size());
  if (start.back() > std::numeric_limits<Index>::max())
    throw ResourceError("the product would have " + std::to_string(start.back()) +
                        " nonzeros, more than 32-bit indices count; use fewer levels or refine fewer faces");
  P.resizeNonZeros(static_cast<Index>(start.back()));
  outer[A.rows()] = static_cast<Index>(start.back());
  parallel_for_blocks(A.rows(), [&](std::int64_t block, std::int64_t begin, std::int64_t end) {
    for (std::int64_t r = begin; r < end; ++r) outer[r] += static_cast<Index>(start[block]);
    std::copy(blocks[block].columns.begin(), blocks[block].columns.end(), P.innerIndexPtr() + start[block]);
    std::copy(blocks[block].values.begin(), blocks[block].values.end(), P.valuePtr() + start[block]);
    blocks[block] = {};
  });
  return P;
}

}  // namespace sublimit
