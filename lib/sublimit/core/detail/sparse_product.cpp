// SPDX-License-Identifier: Apache-2.0
#include "sublimit/core/detail/sparse_product.h"

#include <tbb/enumerable_thread_specific.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <numeric>
#include <string>
#include <vector>

#include "sublimit/base/detail/huge_pages.h"
#include "sublimit/base/detail/parallel_for.h"
#include "sublimit/base/error.h"
#include "sublimit/core/uninitialized.h"

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

/// One row of A * B at a time. The rows of B that meet in a row of A belong to neighbouring points and share most
/// columns: the longest of them gives the columns to start from, which in regular regions are all there are.
class RowProduct {
 public:
  RowProduct(const SparseMatrix& A, const SparseMatrix& B) : A_(A), B_(B), place_(B.cols(), 0) {}

  Index length(Index r) {
    start(r);
    for (Index i = A_.outerIndexPtr()[r]; i < A_.outerIndexPtr()[r + 1]; ++i) {
      const Row row = b_row(A_.innerIndexPtr()[i]);
      if (same_columns(row)) continue;
      for (Index k = 0; k < row.length; ++k)
        if (place(row.columns[k]) >= count_) append(row.columns[k]);
    }
    return static_cast<Index>(count_);
  }

  /// Writes the row's columns, ascending, and their values; both have room for `length(r)`.
  Index write(Index r, Index* columns, double* values) {
    start(r);
    std::copy_n(longest_.columns, longest_.length, columns);
    std::fill_n(values, longest_.length, 0.0);
    for (Index i = A_.outerIndexPtr()[r]; i < A_.outerIndexPtr()[r + 1]; ++i) {
      const Row row = b_row(A_.innerIndexPtr()[i]);
      const double w = A_.valuePtr()[i];
      if (same_columns(row)) {
        for (Index k = 0; k < row.length; ++k) values[k] += w * row.values[k];
        continue;
      }
      for (Index k = 0; k < row.length; ++k) {
        std::uint32_t at = place(row.columns[k]);
        if (at >= count_) {
          at = append(row.columns[k]);
          columns[at] = row.columns[k];
          values[at] = 0;
        }
        values[at] += w * row.values[k];
      }
    }
    if (static_cast<Index>(count_) > longest_.length) put_in_order(columns, values);
    return static_cast<Index>(count_);
  }

 private:
  struct Row {
    const Index* columns;
    const double* values;
    Index length;
  };
  Row b_row(Index r) const {
    const Index begin = B_.outerIndexPtr()[r];
    return {B_.innerIndexPtr() + begin, B_.valuePtr() + begin, B_.outerIndexPtr()[r + 1] - begin};
  }
  bool same_columns(const Row& row) const {
    if (row.columns == longest_.columns) return true;
    return row.length == longest_.length && std::equal(row.columns, row.columns + row.length, longest_.columns);
  }

  /// Places of the columns of the longest row of B that row r needs. Neighbouring rows mostly start from the same ones.
  void start(Index r) {
    Row longest{nullptr, nullptr, 0};
    for (Index i = A_.outerIndexPtr()[r]; i < A_.outerIndexPtr()[r + 1]; ++i) {
      const Row row = b_row(A_.innerIndexPtr()[i]);
      if (row.length > longest.length) longest = row;
    }
    const bool same = static_cast<Index>(count_) == longest_.length && same_columns(longest);
    longest_ = longest;
    if (same) return;
    base_ += count_;
    count_ = 0;
    if (base_ > std::numeric_limits<std::uint32_t>::max() - place_.size()) {
      std::fill(place_.begin(), place_.end(), 0);
      base_ = 1;
    }
    for (Index k = 0; k < longest.length; ++k) append(longest.columns[k]);
  }
  /// Where a column stands in the row; `count_` or more if it does not yet.
  std::uint32_t place(Index column) const { return place_[column] - base_; }
  std::uint32_t append(Index column) {
    place_[column] = base_ + count_;
    return count_++;
  }

  void put_in_order(Index* columns, double* values) {
    const Index count = static_cast<Index>(count_), sorted = longest_.length;
    columns_.assign(columns, columns + count);
    values_.assign(values, values + count);
    std::sort(columns_.begin() + sorted, columns_.end());
    std::merge(columns_.begin(), columns_.begin() + sorted, columns_.begin() + sorted, columns_.end(), columns);
    for (Index k = 0; k < count; ++k) values[k] = values_[place(columns[k])];
  }

  const SparseMatrix& A_;
  const SparseMatrix& B_;
  std::vector<std::uint32_t> place_;  // by column, from base_ on: what earlier rows left behind lies below it
  std::uint32_t base_ = 1, count_ = 0;
  Row longest_{nullptr, nullptr, 0};
  std::vector<Index> columns_;
  std::vector<double> values_;
};

}  // namespace

Points apply(const SparseMatrix& S, const Points& points) {
  if (points.rows() != S.cols())
    throw InvalidParameter("a matrix of " + shape(Index(S.rows()), Index(S.cols())) + " needs " +
                           std::to_string(S.cols()) + " points, not " + std::to_string(points.rows()));
  Points result(S.rows(), points.cols());
  prefer_huge_pages(result.data(), result.size() * sizeof(double));
  const Index channels = static_cast<Index>(points.cols());
  parallel_for_blocks(S.rows(), [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    if (channels == 1) return apply_rows<1>(S, points.data(), result.data(), begin, end);
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
  tbb::enumerable_thread_specific<RowProduct> products([&] { return RowProduct(A, B); });
  std::vector<std::int64_t> start(num_blocks(A.rows()) + 1, 0);
  parallel_for_blocks(A.rows(), [&](std::int64_t block, std::int64_t begin, std::int64_t end) {
    RowProduct& rows = products.local();
    for (std::int64_t r = begin; r < end; ++r) start[block + 1] += rows.length(static_cast<Index>(r));
  });
  std::partial_sum(start.begin(), start.end(), start.begin());
  if (start.back() > std::numeric_limits<Index>::max())
    throw ResourceError("the product would have " + std::to_string(start.back()) +
                        " nonzeros, more than 32-bit indices count; use fewer levels or refine fewer faces");
  SparseMatrix P(A.rows(), B.cols());
  resize_nonzeros(P, start.back());
  Index* const outer = P.outerIndexPtr();
  outer[A.rows()] = static_cast<Index>(start.back());
  parallel_for_blocks(A.rows(), [&](std::int64_t block, std::int64_t begin, std::int64_t end) {
    RowProduct& rows = products.local();
    Index at = static_cast<Index>(start[block]);
    for (std::int64_t r = begin; r < end; ++r) {
      outer[r] = at;
      at += rows.write(static_cast<Index>(r), P.innerIndexPtr() + at, P.valuePtr() + at);
    }
  });
  return P;
}

}  // namespace sublimit
