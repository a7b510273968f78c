// SPDX-License-Identifier: Apache-2.0
#pragma once
// The types of all pieces of a level, and the points that each depends on.
#include <functional>
#include <optional>
#include <vector>

#include "sublimit/neighborhood/regular_faces.h"
#include "sublimit/stencils/patterns/patterns.h"

namespace sublimit {

/// Types and points of pieces. Constant once made: threads may share it.
class PieceMatches {
 public:
  /// Finds the types of `count` pieces.
  /// @param level     faces and half-edges must stay (`TopologyBuilder::corners_only`): nothing is stored for regular
  ///                  faces, which are most of a large mesh
  /// @param piece_at  returns each piece; quadrilaterals and triangles start at the first corner of their face
  /// @param must_pay  give up if computing types takes longer than rows for each piece would
  PieceMatches(Patterns& patterns, const Level& level, Index count, const std::function<Piece(Index)>& piece_at,
               bool must_pay = false);

  /// Returns true if types are shared by many pieces, or are small. If false, nothing else may be called.
  bool pays() const { return pays_; }
  /// Returns the patterns of all pieces, each once, in no order.
  std::vector<const Pattern*> patterns() const;

  Index count() const { return static_cast<Index>(places_.size()); }
  const Pattern& pattern(Index i) const { return places_[i] == is_regular ? *regular_ : *match(i).pattern; }
  /// Returns the corner of the piece that is the first one of its pattern.
  int turn(Index i) const { return places_[i] == is_regular ? 0 : match(i).turn; }
  /// Writes the points that a piece depends on, and returns their end.
  /// @param out  array of `num_slots` of its pattern
  Index* points(Index i, Index* out) const;

 private:
  static constexpr std::int64_t per_chunk = 1024;
  static constexpr std::int16_t is_regular = -1, is_unknown = -2;
  struct Match {
    const Pattern* pattern = nullptr;
    std::int32_t first = 0;  ///< index of its first point
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
  /// Type of regular faces, if their points can be found by walks in the order of `RegularFaces`.
  const Pattern* regular_ = nullptr;
  std::optional<RegularFaces> regular_faces_;
  std::vector<std::int16_t> places_;  // for each piece: index among the matches of its chunk, or a code
  std::vector<Chunk> chunks_;
};

}  // namespace sublimit
