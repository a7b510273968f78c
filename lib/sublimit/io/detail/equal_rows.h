// SPDX-License-Identifier: Apache-2.0
#pragma once
// Numbers for rows of three or more numbers by their values: equal rows have the same one. For files without shared
// vertices, and for values of corners that are the same at a vertex.
#include <array>
#include <bit>
#include <cstdint>
#include <vector>

#include "sublimit/core/types.h"

namespace sublimit {

/// Rows of `N` finite numbers, each once, in the order in which they were first added. Zero has no sign.
template <std::size_t N>
class EqualRowsOf {
 public:
  using Row = std::array<double, N>;

  /// Returns the number of a row, which is a new one if no equal row was added before.
  Index add(const Row& row) {
    if (2 * (rows_.size() + 1) > slots_.size()) grow();
    Index& slot = slots_[find(row)];
    if (slot < 0) {
      slot = static_cast<Index>(rows_.size());
      rows_.push_back(row);
      for (double& x : rows_.back()) x += 0;  // -0 + 0 is +0
    }
    return slot;
  }

  /// Returns the rows, each once, in the order in which they came.
  const std::vector<Row>& rows() const { return rows_; }

 private:
  static std::uint64_t hash(const Row& row) {
    std::uint64_t h = 0;
    for (const double x : row) {
      h = (h ^ std::bit_cast<std::uint64_t>(x + 0)) * 0x9E3779B97F4A7C15u;
      h ^= h >> 32;
    }
    return h;
  }

  // The slot of a row, or the empty one where it would be.
  std::size_t find(const Row& row) const {
    const std::size_t mask = slots_.size() - 1;
    std::size_t at = static_cast<std::size_t>(hash(row)) & mask;
    while (slots_[at] >= 0 && rows_[static_cast<std::size_t>(slots_[at])] != row) at = (at + 1) & mask;
    return at;
  }

  void grow() {
    slots_.assign(slots_.empty() ? 64 : 2 * slots_.size(), -1);
    for (std::size_t i = 0; i < rows_.size(); ++i) slots_[find(rows_[i])] = static_cast<Index>(i);
  }

  std::vector<Row> rows_;
  std::vector<Index> slots_;  // a power of two, at most half of them taken; -1: empty
};
/// Rows of three numbers.
using EqualRows = EqualRowsOf<3>;

}  // namespace sublimit
