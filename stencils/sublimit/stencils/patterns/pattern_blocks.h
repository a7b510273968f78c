// SPDX-License-Identifier: Apache-2.0
#pragma once
// The blocks of weights of a table being baked.
#include <algorithm>
#include <atomic>
#include <span>
#include <unordered_map>
#include <vector>

#include "sublimit/base/detail/parallel_for.h"
#include "sublimit/base/error.h"
#include "sublimit/eval/table/pattern_table.h"
#include "sublimit/stencils/patterns/patterns.h"

namespace sublimit {

/// Blocks of a table in the order of their first pieces, computed in parallel.
class PatternBlocks {
 public:
  /// @param scheme  patterns of a scheme with wide masks have more points than they use; unused ones get no columns
  explicit PatternBlocks(const Scheme<double>& scheme) : drops_unused_(!scheme.has_one_ring_limits()) {}

  /// A block's pattern, and its place if the weights depend on it.
  struct Key {
    const Pattern* pattern = nullptr;
    LatticePlace place;  ///< only its turn and quarter are used
    bool operator==(const Key& other) const {
      return pattern == other.pattern && place.turn == other.place.turn && place.quarter == other.place.quarter;
    }
  };
  /// Returns the number of the block of a key, which is added if it is new.
  /// @param piece  a piece with this block
  Index add(const Key& key, Index piece) {
    if (!keys_.empty() && keys_[last_] == key) return last_;  // on large meshes most are like the one before
    const auto [at, is_new] = numbers_.try_emplace(key, static_cast<Index>(keys_.size()));
    if (is_new) {
      keys_.push_back(key);
      pieces_.push_back(piece);
    }
    return last_ = at->second;
  }
  const std::vector<Key>& keys() const { return keys_; }
  Index count() const { return static_cast<Index>(keys_.size()); }
  /// Returns the first piece with a block.
  Index piece(Index block) const { return pieces_[block]; }

  /// Returns the slots of the pattern that the columns of a block stand for, after `fill`.
  std::span<const Index> slots(Index block) const { return slots_[block]; }

  /// Computes the weights of all blocks into `arrays`. Returns false if a block has none.
  /// @param rows  returns the number of points of a block, by its number
  /// @param make  returns the weights of a block, or null. Called in order for types whose sums have an order
  template <class Rows, class Make>
  bool fill(PatternTable<double>::Arrays& arrays, const Rows& rows, const Make& make) {
    std::vector<const RowMatrix*> made(keys_.size());
    slots_.resize(keys_.size());
    std::atomic<bool> failed = false;
    const auto made_or_null = [&](Index i) -> const RowMatrix* {
      try {
        if (!failed) return make(i);
      } catch (const AnalysisError&) {
        failed = true;  // the neighbourhood never becomes stationary; rows may be possible
      }
      return nullptr;
    };
    for (Index i = 0; i < count(); ++i)
      if (keys_[i].pattern->decays) made[i] = made_or_null(i);
    parallel_for_blocks(
        static_cast<std::int64_t>(keys_.size()),
        [&](std::int64_t i, std::int64_t, std::int64_t) {
          if (!made[i]) made[i] = made_or_null(static_cast<Index>(i));
          if (made[i]) slots_[i] = used_slots(*made[i]);
        },
        1);
    if (std::find(made.begin(), made.end(), nullptr) != made.end()) return false;
    size_t size = 0;
    for (size_t i = 0; i < made.size(); ++i) size += size_t(made[i]->rows()) * slots_[i].size();
    std::vector<double> weights;
    weights.reserve(size);
    for (Index i = 0; i < count(); ++i) {
      const RowMatrix& W = *made[i];
      arrays.blocks.push_back(
          {rows(i), static_cast<std::int32_t>(slots_[i].size()), static_cast<std::int64_t>(weights.size())});
      if (std::ssize(slots_[i]) == W.cols()) {
        weights.insert(weights.end(), W.data(), W.data() + W.size());
        continue;
      }
      for (Eigen::Index row = 0; row < W.rows(); ++row)
        for (const Index slot : slots_[i]) weights.push_back(W(row, slot));
    }
    arrays.weights = std::move(weights);
    return true;
  }
  /// Returns an upper bound of the size of all weights in bytes.
  /// @param rows  returns the number of rows of a block, all quantities together, by its number
  template <class Rows>
  double num_bytes(const Rows& rows) const {
    double bytes = 0;
    for (Index i = 0; i < count(); ++i) bytes += double(rows(i)) * keys_[i].pattern->num_slots * sizeof(double);
    return bytes;
  }

 private:
  struct Hash {
    size_t operator()(const Key& key) const {
      return key.pattern->number * 128 + size_t(8 * (key.place.quarter + 1) + key.place.turn);
    }
  };
  std::vector<Index> used_slots(const RowMatrix& W) const {
    std::vector<Index> used;
    for (Index slot = 0; slot < W.cols(); ++slot)
      if (!drops_unused_ || !W.col(slot).isZero(0)) used.push_back(slot);
    return used;
  }
  bool drops_unused_;
  std::vector<std::vector<Index>> slots_;
  std::unordered_map<Key, Index, Hash> numbers_;
  std::vector<Key> keys_;
  std::vector<Index> pieces_;
  Index last_ = 0;
};

}  // namespace sublimit
