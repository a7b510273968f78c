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

/// One row of A * B at a time: sums in a dense array, of which the touched columns are listed.
class RowProduct {
 public:
  RowProduct(const SparseMatrix& A, const SparseMatrix& B) : A_(A), B_(B), sum_(B.cols()), touched_by_(B.cols(), -1) {}

  void append(Index r, std::vector<Index>& columns, std::vector<double>& values) {
    const size_t begin = columns.size();
    for (Index i = A_.outerIndexPtr()[r]; i < A_.outerIndexPtr()[r + 1]; ++i) {
      const Index row = A_.innerIndexPtr()[i];
      const double w = A_.valuePtr()[i];
      for (Index k = B_.outerIndexPtr()[row]; k < B_.outerIndexPtr()[row + 1]; ++k) {
        const Index c = B_.innerIndexPtr()[k];
        if (touched_by_[c] != r) {
          touched_by_[c] = r;
          sum_[c] = w * B_.valuePtr()[k];
          columns.push_back(c);
        } else {
          sum_[c] += w * B_.valuePtr()[k];
        }
      }
    }
    std::sort(columns.begin() + begin, columns.end());
    for (size_t k = begin; k < columns.size(); ++k) values.push_back(sum_[columns[k]]);
  }

 private:
  const SparseMatrix& A_;
  const SparseMatrix& B_;
  std::vector<double> sum_;
  std::vector<Index> touched_by_;
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
  struct Block {
    std::vector<Index> columns;
    std::vector<double> values;
  };
  std::vector<Block> blocks(num_blocks(A.rows()));
  SparseMatrix P(A.rows(), B.cols());
  Index* const outer = P.outerIndexPtr();
  tbb::enumerable_thread_specific<RowProduct> workers([&] { return RowProduct(A, B); });
  parallel_for_blocks(A.rows(), [&](std::int64_t block, std::int64_t begin, std::int64_t end) {
    RowProduct& worker = workers.local();
    for (std::int64_t r = begin; r < end; ++r) {
      outer[r] = static_cast<Index>(blocks[block].columns.size());  // within the block, for now
      worker.append(static_cast<Index>(r), blocks[block].columns, blocks[block].values);
    }
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
