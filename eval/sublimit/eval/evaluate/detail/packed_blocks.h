// SPDX-License-Identifier: Apache-2.0
#pragma once
// Weights of a table by patterns in the order in which kernels read them: column after column, the rows of a column
// side by side. Each block is packed once for all groups that use it; a group skips registers without a row of its own.
// With many types and few patches, separate packings would take longer to read than to multiply. A group of many
// patches that would skip many registers has its own packing.
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "sublimit/eval/kernels/packed_rows.h"
#include "sublimit/eval/table/pattern_table.h"

namespace sublimit {

template <class Real>
class PackedBlocks {
 public:
  /// Packed weights of a group.
  struct Group {
    const Real* weights = nullptr;  ///< weights of all quantities
    std::int64_t stride = 0;        ///< numbers from column to column
    std::int64_t quantity = 0;      ///< numbers from quantity to quantity
    std::span<const PackedRows> rows;
  };
  explicit PackedBlocks(const PatternTable<Real>& table);

  /// Returns the packed weights of a group, which has at least one row and column.
  Group group(size_t i) const {
    const Entry& place = places_[i];
    return {weights_.get() + place.weights, place.stride, place.quantity,
            std::span(rows_).subspan(place.first, place.count)};
  }
  std::int64_t num_bytes() const;

 private:
  struct Entry {
    std::int64_t weights = 0, stride = 0, quantity = 0;
    size_t first = 0, count = 0;  // in rows_
  };
  struct Free {
    void operator()(Real* weights) const;
  };
  std::vector<Entry> places_;
  std::vector<PackedRows> rows_;
  std::unique_ptr<Real[], Free> weights_;  // aligned as registers are
  std::int64_t num_weights_ = 0;
};

extern template class PackedBlocks<float>;
extern template class PackedBlocks<double>;

}  // namespace sublimit
