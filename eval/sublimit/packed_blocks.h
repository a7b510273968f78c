// SPDX-License-Identifier: Apache-2.0
#pragma once
// Weights of a table by patterns as its kernels read them: column after column, rows side by side. Packed once for each
// block, and used by all groups that take rows of it, each leaving out registers that have no row of its own: where
// types are many and patches few, weights would else take longer to read than to multiply. A group of many patches that
// leaves out much has a packing of its own.
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "sublimit/packed_rows.h"
#include "sublimit/pattern_table.h"

namespace sublimit {

template <class Real>
class PackedBlocks {
 public:
  /// What a group of the table reads.
  struct Group {
    const Real* weights = nullptr;  ///< of all quantities
    std::int64_t stride = 0;        ///< between columns
    std::int64_t quantity = 0;      ///< between quantities
    std::span<const PackedRows> rows;
  };
  explicit PackedBlocks(const PatternTable<Real>& table);

  /// Of a group with at least one row and column.
  Group group(size_t i) const {
    const Place& place = places_[i];
    return {weights_.get() + place.weights, place.stride, place.quantity,
            std::span(rows_).subspan(place.first, place.count)};
  }
  std::int64_t num_bytes() const;

 private:
  struct Place {
    std::int64_t weights = 0, stride = 0, quantity = 0;
    size_t first = 0, count = 0;  // in rows_
  };
  struct Free {
    void operator()(Real* weights) const;
  };
  std::vector<Place> places_;
  std::vector<PackedRows> rows_;
  std::unique_ptr<Real[], Free> weights_;  // aligned as registers are
  std::int64_t num_weights_ = 0;
};

extern template class PackedBlocks<float>;
extern template class PackedBlocks<double>;

}  // namespace sublimit
