// SPDX-License-Identifier: Apache-2.0
#pragma once
// The types of all pieces of a level, and the points that each depends on.
#include <functional>
#include <span>
#include <vector>

#include "sublimit/patterns/patterns.h"

namespace sublimit {

class PieceMatches {
 public:
  /// @param piece_at  of each number below `count`; quadrilaterals and triangles begin as their faces do
  PieceMatches(Patterns& patterns, const Level& level, Index count, const std::function<Piece(Index)>& piece_at);

  Index count() const { return static_cast<Index>(matches_.size()); }
  const Pattern& pattern(Index i) const { return *matches_[i].pattern; }
  /// The corner of the piece that is the pattern's first one.
  int turn(Index i) const { return matches_[i].turn; }
  std::span<const Index> vertices(Index i) const {
    return {chunks_[matches_[i].chunk].data() + matches_[i].first, size_t(matches_[i].pattern->num_slots)};
  }

 private:
  struct Match {
    const Pattern* pattern = nullptr;
    std::int32_t chunk = 0, first = 0;
    std::int8_t turn = 0;
  };
  bool find(Patterns& patterns, const Level& level, const Piece& piece, Index i, size_t chunk);
  void set(Index i, size_t chunk, const Patterns::Match& match);
  std::vector<Match> matches_;
  std::vector<std::vector<Index>> chunks_;  // a block of pieces each
};

}  // namespace sublimit
