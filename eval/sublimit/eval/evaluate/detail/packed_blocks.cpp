// SPDX-License-Identifier: Apache-2.0
#include "sublimit/eval/evaluate/detail/packed_blocks.h"

#include <algorithm>
#include <new>

#include "sublimit/base/detail/huge_pages.h"
#include "sublimit/base/detail/parallel_for.h"

namespace sublimit {
namespace {

constexpr std::align_val_t alignment{64};

/// So many patches pay for weights of their own, if these are fewer.
constexpr std::int64_t patches_of_own = 16;

std::int64_t num_registers(std::int64_t rows) { return (rows + row_multiple - 1) / row_multiple; }

/// Rows in an order that has those of each list in theirs, or none if there is no such order. Keeps its memory.
class CommonOrder {
 public:
  std::span<const std::int32_t> of(std::int32_t num_rows, const std::vector<std::span<const std::int32_t>>& lists) {
    // Kahn 1962: a row comes when all that precede it in some list have come. The last one that can goes first, which
    // keeps rows together that follow each other.
    before_.assign(size_t(num_rows), 0);
    first_.assign(size_t(num_rows), none);
    edges_.clear(), ready_.clear(), order_.clear();
    std::int32_t total = 0;
    for (const auto& list : lists)
      for (size_t i = 0; i < list.size(); ++i) {
        if (first_[list[i]] == none) ++total, first_[list[i]] = last;
        if (i == 0) continue;
        ++before_[list[i]];
        edges_.push_back({list[i], first_[list[i - 1]]});
        first_[list[i - 1]] = static_cast<std::int64_t>(edges_.size()) - 1;
      }
    for (std::int32_t row = num_rows - 1; row >= 0; --row)
      if (first_[row] != none && before_[row] == 0) ready_.push_back(row);
    while (!ready_.empty()) {
      const std::int32_t row = ready_.back();
      ready_.pop_back();
      order_.push_back(row);
      for (std::int64_t e = first_[row]; e >= 0; e = edges_[e].next)
        if (--before_[edges_[e].to] == 0) ready_.push_back(edges_[e].to);
    }
    if (std::int32_t(order_.size()) < total) order_.clear();
    return order_;
  }

 private:
  static constexpr std::int64_t none = -2, last = -1;
  struct Edge {
    std::int32_t to;
    std::int64_t next;
  };
  std::vector<std::int32_t> before_, ready_, order_;
  std::vector<std::int64_t> first_;
  std::vector<Edge> edges_;
};

}  // namespace

template <class Real>
void PackedBlocks<Real>::Free::operator()(Real* weights) const {
  ::operator delete(weights, alignment);
}

template <class Real>
PackedBlocks<Real>::PackedBlocks(const PatternTable<Real>& table) {
  const auto& a = table.arrays();
  const auto rows_of = [&](size_t g) { return a.rows.span().subspan(a.groups[g].rows, a.groups[g].num_rows); };
  std::vector<size_t> by_block(a.groups.size());
  for (size_t g = 0; g < by_block.size(); ++g) by_block[g] = g;
  std::stable_sort(by_block.begin(), by_block.end(),
                   [&](size_t g, size_t h) { return a.groups[g].block < a.groups[h].block; });

  // Packings: of which block, which rows of it.
  struct Packing {
    std::int32_t block;
    size_t first, count;  // in `order`
    std::int64_t weights;
  };
  std::vector<Packing> packings;
  std::vector<std::int32_t> order;
  const auto pack = [&](std::int32_t block, std::span<const std::int32_t> rows) {
    packings.push_back({block, order.size(), rows.size(), num_weights_});
    order.insert(order.end(), rows.begin(), rows.end());
    num_weights_ += num_registers(std::int64_t(rows.size())) * row_multiple * a.blocks[block].columns * a.quantities;
  };
  const auto place = [&](size_t g, size_t num_rows, size_t first) {
    const Packing& packing = packings.back();
    const std::int64_t stride = num_registers(std::int64_t(num_rows)) * row_multiple;
    places_[g] = {packing.weights, stride, stride * a.blocks[packing.block].columns, first, rows_.size() - first};
  };
  const auto pack_own = [&](size_t g) {
    const std::span<const std::int32_t> rows = rows_of(g);
    pack(a.groups[g].block, rows);
    const size_t first = rows_.size();
    const auto count = static_cast<std::int32_t>(rows.size());
    for (std::int32_t row = 0; row < count; row += row_multiple)
      rows_.push_back({row, row, (1u << std::min(row_multiple, count - row)) - 1});
    place(g, rows.size(), first);
  };
  places_.resize(a.groups.size());
  CommonOrder common;
  std::vector<std::span<const std::int32_t>> lists;
  std::vector<std::int32_t> position;
  for (size_t begin = 0, end; begin < by_block.size(); begin = end) {
    const std::int32_t block = a.groups[by_block[begin]].block;
    for (end = begin; end < by_block.size() && a.groups[by_block[end]].block == block; ++end) continue;
    lists.clear();
    for (size_t i = begin; i < end; ++i) lists.push_back(rows_of(by_block[i]));
    const std::span<const std::int32_t> shared =
        lists.size() == 1 ? std::span<const std::int32_t>() : common.of(a.blocks[block].rows, lists);
    if (shared.empty()) {
      for (size_t i = begin; i < end; ++i) pack_own(by_block[i]);
      continue;
    }
    position.resize(size_t(a.blocks[block].rows));
    for (size_t i = 0; i < shared.size(); ++i) position[shared[i]] = static_cast<std::int32_t>(i);
    bool packed = false;
    for (size_t i = begin; i < end; ++i) {
      const size_t g = by_block[i], first = rows_.size();
      std::int32_t to = 0;
      for (const std::int32_t row : rows_of(g)) {
        const std::int32_t at = position[row], lane = at % row_multiple;
        if (rows_.size() == first || rows_.back().first != at - lane) rows_.push_back({at - lane, to, 0});
        rows_.back().taken |= 1u << lane;
        ++to;
      }
      if (a.groups[g].num_patches >= patches_of_own && std::int64_t(rows_.size() - first) > num_registers(to)) {
        rows_.resize(first);
        continue;
      }
      if (!packed) pack(block, shared);
      packed = true;
      place(g, shared.size(), first);
    }
    for (size_t i = begin; i < end; ++i)
      if (places_[by_block[i]].count == 0) pack_own(by_block[i]);
  }

  const auto bytes = static_cast<size_t>(num_weights_) * sizeof(Real);
  weights_.reset(static_cast<Real*>(::operator new(bytes, alignment)));
  prefer_huge_pages(weights_.get(), bytes);
  parallel_for_blocks(
      static_cast<std::int64_t>(packings.size()),
      [&](std::int64_t p, std::int64_t, std::int64_t) {
        const Packing& packing = packings[p];
        const auto& block = a.blocks[packing.block];
        const std::int64_t stride = num_registers(std::int64_t(packing.count)) * row_multiple;
        Real* out = weights_.get() + packing.weights;
        for (int q = 0; q < a.quantities; ++q, out += stride * block.columns) {
          const Real* matrix = a.weights.data() + block.weights + q * std::int64_t{block.rows} * block.columns;
          for (std::int64_t i = 0; i < stride; ++i) {
            const bool padding = i >= std::int64_t(packing.count);
            const Real* row = matrix + std::int64_t{order[padding ? packing.first : packing.first + i]} * block.columns;
            for (std::int32_t k = 0; k < block.columns; ++k) out[k * stride + i] = padding ? Real(0) : row[k];
          }
        }
      },
      1);
}

template <class Real>
std::int64_t PackedBlocks<Real>::num_bytes() const {
  return num_weights_ * std::int64_t(sizeof(Real)) + std::int64_t(rows_.size() * sizeof(PackedRows)) +
         std::int64_t(places_.size() * sizeof(Entry));
}

template class PackedBlocks<float>;
template class PackedBlocks<double>;

}  // namespace sublimit
