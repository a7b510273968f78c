// SPDX-License-Identifier: Apache-2.0
#pragma once
// The size of a table by patterns, counted without making it.
#include "sublimit/stencils/bake/detail/bake.h"
#include "sublimit/stencils/patterns/patch_groups.h"
#include "sublimit/stencils/patterns/pattern_blocks.h"

namespace sublimit {

inline Index num_types(const PieceMatches& pieces) { return static_cast<Index>(pieces.patterns().size()); }

/// Counts the sizes of groups without making them; an upper bound for wide masks.
/// @param rows    returns the number of rows of a block, all quantities together, by its number
/// @param length  returns the number of rows of a group
template <class Rows, class Length>
void count(const PatternBlocks& blocks, const PatchGroups& groups, const Rows& rows, const Length& length,
           BakeStatistics& s) {
  std::int64_t chosen = 0, columns = 0;
  for (const PatchGroups::Group& group : groups.groups) {
    const std::int64_t own = length(group);
    columns += std::ssize(group.pieces) * blocks.keys()[group.block].pattern->num_slots;
    s.points += std::ssize(group.pieces) * own;
    chosen += own;
    ++s.groups;
  }
  s.blocks = blocks.count();
  s.weights = static_cast<std::int64_t>(blocks.num_bytes(rows)) / std::int64_t(sizeof(double));
  s.bytes = std::int64_t(sizeof(double)) * s.weights + 4 * (chosen + columns) +
            std::int64_t(sizeof(PatternTable<double>::Block)) * s.blocks +
            std::int64_t(sizeof(PatternTable<double>::Group)) * s.groups;
}

/// Counts isolated vertices, which have a block of their own.
inline void count_isolated(const Topology& t, int quantities, BakeStatistics& s) {
  std::int64_t alone = 0;
  for (Index v = 0; v < t.num_vertices(); ++v) alone += t.is_isolated(Vertex{v});
  if (alone == 0) return;
  ++s.blocks;
  ++s.groups;
  s.points += alone;
  s.weights += quantities;
  s.bytes += std::int64_t(sizeof(double)) * quantities + 4 * (1 + alone) +
             std::int64_t(sizeof(PatternTable<double>::Block) + sizeof(PatternTable<double>::Group));
}

}  // namespace sublimit
