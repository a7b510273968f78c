// SPDX-License-Identifier: Apache-2.0
#pragma once
// The blocks of a table that is being made.
#include <algorithm>
#include <atomic>
#include <unordered_map>
#include <vector>

#include "sublimit/base/error.h"
#include "sublimit/base/parallel_for.h"
#include "sublimit/pattern_table.h"
#include "sublimit/patterns/patterns.h"

namespace sublimit {

/// Blocks of a table, in the order in which pieces meet them, made in parallel.
class PatternBlocks {
 public:
  struct Key {
    const Pattern* pattern = nullptr;
    LatticePlace place;  ///< where it matters: its turn and quarter
    bool operator==(const Key& other) const {
      return pattern == other.pattern && place.turn == other.place.turn && place.quarter == other.place.quarter;
    }
  };
  /// @param piece  that has it
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
  /// The first piece that has it.
  Index piece(Index block) const { return pieces_[block]; }

  /// @param rows       points of a block
  /// @param make       weights of a block, or null: those of types whose sums have an order are asked for in turn
  /// @return  false if one is null
  template <class Make>
  bool fill(PatternTable<double>::Arrays& arrays, std::int32_t rows, const Make& make) const {
    std::vector<const RowMatrix*> made(keys_.size());
    std::atomic<bool> failed = false;
    const auto made_or_null = [&](Index i) -> const RowMatrix* {
      try {
        if (!failed) return make(i);
      } catch (const AnalysisError&) {
        failed = true;  // a neighbourhood that never comes to repeat itself: rows may know what to do
      }
      return nullptr;
    };
    for (Index i = 0; i < count(); ++i)
      if (keys_[i].pattern->decays) made[i] = made_or_null(i);
    parallel_for_blocks(
        static_cast<std::int64_t>(keys_.size()),
        [&](std::int64_t i, std::int64_t, std::int64_t) {
          if (!made[i]) made[i] = made_or_null(static_cast<Index>(i));
        },
        1);
    if (std::find(made.begin(), made.end(), nullptr) != made.end()) return false;
    size_t size = 0;
    for (const RowMatrix* W : made) size += size_t(W->size());
    std::vector<double> weights;
    weights.reserve(size);
    for (const RowMatrix* W : made) {
      arrays.blocks.push_back({rows, static_cast<std::int32_t>(W->cols()), static_cast<std::int64_t>(weights.size())});
      weights.insert(weights.end(), W->data(), W->data() + W->size());
    }
    arrays.weights = std::move(weights);
    return true;
  }
  double num_bytes(double rows) const {
    double bytes = 0;
    for (const Key& key : keys_) bytes += rows * key.pattern->num_slots * sizeof(double);
    return bytes;
  }

 private:
  struct Hash {
    size_t operator()(const Key& key) const {
      return key.pattern->number * 128 + size_t(8 * (key.place.quarter + 1) + key.place.turn);
    }
  };
  std::unordered_map<Key, Index, Hash> numbers_;
  std::vector<Key> keys_;
  std::vector<Index> pieces_;
  Index last_ = 0;
};

}  // namespace sublimit
