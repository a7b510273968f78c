// SPDX-License-Identifier: Apache-2.0
#pragma once
// What a table by patterns will take, without making it.
#include "sublimit/bake/bake.h"
#include "sublimit/patterns/patch_groups.h"
#include "sublimit/patterns/pattern_blocks.h"

namespace sublimit {

inline Index num_types(const PieceMatches& pieces) {
  std::vector<size_t> numbers;
  for (Index i = 0; i < pieces.count(); ++i)
    if (const size_t number = pieces.pattern(i).number; numbers.empty() || number != numbers.back())
      numbers.push_back(number);
  std::sort(numbers.begin(), numbers.end());
  return static_cast<Index>(std::unique(numbers.begin(), numbers.end()) - numbers.begin());
}

/// Whether pieces of the same type are so many, or types so small, that making these takes less time than rows of their
/// own: a type takes about as the square of its points, a row as their number.
inline bool types_pay(const PieceMatches& pieces) {
  constexpr double squares_per_point = 64;
  std::vector<const Pattern*> types;
  double points = 0, squares = 0;
  for (Index i = 0; i < pieces.count(); ++i) {
    const Pattern& type = pieces.pattern(i);
    points += type.num_slots;
    if (types.empty() || &type != types.back()) types.push_back(&type);
  }
  std::sort(types.begin(), types.end());
  types.erase(std::unique(types.begin(), types.end()), types.end());
  for (const Pattern* type : types) squares += double(type->num_slots) * type->num_slots;
  return squares <= squares_per_point * points;
}

/// What groups take, without making them; of wide masks, at most.
/// @param rows    of a block, quantities together, by its number
/// @param length  rows of a group
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

/// Those that have a block of their own.
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
