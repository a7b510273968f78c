// SPDX-License-Identifier: Apache-2.0
#pragma once
// The types of all pieces of a level, and the points that each depends on.
#include <functional>
#include <optional>
#include <vector>

#include "sublimit/neighborhood/regular_faces.h"
#include "sublimit/patterns/patterns.h"

namespace sublimit {

class PieceMatches {
 public:
  /// @param level     whose faces and half-edges are to stay (`TopologyBuilder::corners_only`): of regular faces, which
  ///                  are most of a large mesh, nothing is kept
  /// @param piece_at  of each number below `count`; quadrilaterals and triangles begin as their faces do
  /// @param must_pay  to give up where making types takes longer than rows for each piece would
  PieceMatches(Patterns& patterns, const Level& level, Index count, const std::function<Piece(Index)>& piece_at,
               bool must_pay = false);

  /// Types are shared by many pieces, or small. Else it was given up, and there is nothing else to be asked.
  bool pays() const { return pays_; }
  /// That the pieces have, each once, in no order.
  std::vector<const Pattern*> patterns() const;

  Index count() const { return static_cast<Index>(places_.size()); }
  const Pattern& pattern(Index i) const { return places_[i] == is_regular ? *regular_ : *match(i).pattern; }
  /// The corner of the piece that is the pattern's first one.
  int turn(Index i) const { return places_[i] == is_regular ? 0 : match(i).turn; }
  /// The points that a piece depends on.
  /// @param out  `num_slots` of its pattern
  /// @return     the end of them
  Index* points(Index i, Index* out) const;

 private:
  static constexpr std::int64_t per_chunk = 1024;
  static constexpr std::int16_t is_regular = -1, is_unknown = -2;
  struct Match {
    const Pattern* pattern = nullptr;
    std::int32_t first = 0;  ///< where its points begin
    std::int8_t turn = 0;
  };
  struct Chunk {
    std::vector<Match> matches;
    std::vector<Index> points;
  };
  void find_regular(Patterns& patterns, const Level& level, Index count, const std::function<Piece(Index)>& piece_at);
  void set(Index i, const Patterns::Match& match);
  const Match& match(Index i) const { return chunks_[size_t(i / per_chunk)].matches[size_t(places_[i])]; }

  bool pays_ = true;
  /// The type of regular faces, if walks find their points in the order of `RegularFaces`.
  const Pattern* regular_ = nullptr;
  std::optional<RegularFaces> regular_faces_;
  std::vector<std::int16_t> places_;  // of a piece: among the matches of its chunk, or a sign
  std::vector<Chunk> chunks_;
};

}  // namespace sublimit
