// SPDX-License-Identifier: Apache-2.0
#pragma once
// The patches of a table that is being made.
#include <cstdint>
#include <span>
#include <vector>

#include "sublimit/stencils/patterns/pattern_blocks.h"
#include "sublimit/stencils/patterns/piece_matches.h"

namespace sublimit {

/// Patches by block and share, those of a group in the order of their pieces.
class PatchGroups {
 public:
  /// @param block  of a piece; -1: it makes no points
  /// @param share  of a piece: what it has of its block's rows
  PatchGroups(const PieceMatches& pieces, std::span<const Index> block, std::span<const std::uint8_t> share);

  PatchGroups(const PatchGroups&) = delete;
  PatchGroups& operator=(const PatchGroups&) = delete;

  struct Group {
    Index block;
    std::uint8_t share;
    std::span<const Index> pieces;
  };
  std::vector<Group> groups;

 private:
  std::vector<Index> pieces_;  // group by group
};

/// Control points of all patches, those of isolated points last.
/// @param blocks  that are made
std::vector<std::int32_t> all_columns(const PieceMatches& pieces, const PatternBlocks& blocks,
                                      const PatchGroups& groups, std::span<const Index> alone);

}  // namespace sublimit
