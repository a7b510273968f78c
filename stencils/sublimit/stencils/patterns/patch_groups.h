// SPDX-License-Identifier: Apache-2.0
#pragma once
// The groups of patches of a table that is being made.
#include <cstdint>
#include <span>
#include <vector>

#include "sublimit/stencils/patterns/pattern_blocks.h"
#include "sublimit/stencils/patterns/piece_matches.h"

namespace sublimit {

/// Patches grouped by block and share; those of a group are in the order of their pieces.
class PatchGroups {
 public:
  /// @param block  block of each piece; -1: it makes no points
  /// @param share  for each piece: which rows of its block it makes
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

/// Returns the control points of all patches; isolated points are last.
/// @param blocks  filled blocks
std::vector<std::int32_t> all_columns(const PieceMatches& pieces, const PatternBlocks& blocks,
                                      const PatchGroups& groups, std::span<const Index> alone);

}  // namespace sublimit
