// SPDX-License-Identifier: Apache-2.0
#pragma once
// Sparse rows of a few terms each, stored contiguously.
#include <cstdint>
#include <deque>
#include <span>
#include <utility>
#include <vector>

#include "sublimit/core/types.h"

namespace sublimit {

class SparseRows {
 public:
  using Term = std::pair<Index, double>;
  using Row = std::span<const Term>;  ///< columns ascending

  size_t size() const { return ends_.size(); }
  Row operator[](size_t i) const {
    const size_t begin = i == 0 ? 0 : ends_[i - 1];
    return Row(terms_).subspan(begin, ends_[i] - begin);
  }
  /// Returns the number of terms in all rows.
  size_t num_terms() const { return terms_.size(); }

  void reserve(size_t rows, size_t terms) {
    ends_.reserve(rows);
    terms_.reserve(terms);
  }
  /// Adds a weight to the current row. Columns of a row must ascend; weights of one column are summed.
  void add(Index column, double weight) {
    const size_t begin = ends_.empty() ? 0 : ends_.back();
    if (terms_.size() > begin && terms_.back().first == column)
      terms_.back().second += weight;
    else
      terms_.push_back({column, weight});
  }
  void end_row() { ends_.push_back(static_cast<std::uint32_t>(terms_.size())); }
  void add_row(Row row) {
    terms_.insert(terms_.end(), row.begin(), row.end());
    end_row();
  }

 private:
  std::vector<Term> terms_;
  std::vector<std::uint32_t> ends_;
};

/// @throws ResourceError  more nonzeros than 32-bit indices count
SparseMatrix matrix_of(std::span<const SparseRows::Row> rows, Index columns);

/// Blocks of rows, one below the other. Eigen's sparse matrices copy instead of moving, so blocks are never
/// relocated.
class StackedRows {
 public:
  bool empty() const { return blocks_.empty(); }
  void add(SparseMatrix&& block) { block.swap(blocks_.emplace_back()); }
  /// Returns all blocks as one matrix; the memory of each block is freed once it is copied.
  /// @throws ResourceError  more nonzeros than 32-bit indices count
  SparseMatrix matrix(Index columns) &&;

 private:
  std::deque<SparseMatrix> blocks_;
};

}  // namespace sublimit
