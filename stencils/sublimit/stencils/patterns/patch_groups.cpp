// SPDX-License-Identifier: Apache-2.0
#include "sublimit/stencils/patterns/patch_groups.h"

#include <algorithm>
#include <numeric>
#include <tuple>
#include <unordered_map>

#include "sublimit/base/detail/parallel_for.h"

namespace sublimit {

PatchGroups::PatchGroups(const PieceMatches& pieces, std::span<const Index> block,
                         std::span<const std::uint8_t> share) {
  const Index count = pieces.count();
  struct Counted {
    Group group;
    size_t size = 0, first = 0;  ///< of its pieces
  };
  std::vector<Counted> counted;
  std::unordered_map<std::int64_t, Index> numbers;
  // Calls body(number of the group, piece); most pieces are of the group of the one before.
  const auto for_each_piece = [&](const auto& body) {
    std::int64_t last = -1;
    Index number = -1;
    for (Index i = 0; i < count; ++i) {
      if (block[i] < 0) continue;
      const std::int64_t key = std::int64_t{block[i]} * 256 + share[i];
      if (key != last) {
        const auto [at, is_new] = numbers.try_emplace(key, static_cast<Index>(counted.size()));
        if (is_new) counted.push_back({{block[i], share[i], {}}});
        number = at->second;
        last = key;
      }
      body(number, i);
    }
  };
  for_each_piece([&](Index number, Index) { ++counted[number].size; });
  std::vector<Index> order(counted.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](Index a, Index b) {
    const Group &x = counted[a].group, &y = counted[b].group;
    return std::tie(x.block, x.share) < std::tie(y.block, y.share);
  });
  size_t next = 0;
  for (const Index number : order) {
    counted[number].first = next;
    next += counted[number].size;
  }
  pieces_.resize(next);
  for (const Index number : order) {
    const Counted& c = counted[number];
    groups.push_back({c.group.block, c.group.share, {pieces_.data() + c.first, c.size}});
  }
  for_each_piece([&](Index number, Index i) { pieces_[counted[number].first++] = i; });
}

std::vector<std::int32_t> all_columns(const PieceMatches& pieces, const PatternBlocks& blocks,
                                      const PatchGroups& groups, std::span<const Index> alone) {
  struct Run {
    std::int64_t first;  // where its control points begin
    std::span<const Index> pieces;
    Index num_points;  // of each
    std::span<const Index> slots;
  };
  constexpr size_t per_run = 1024;
  std::vector<Run> runs;
  std::int64_t next = 0;
  for (const PatchGroups::Group& group : groups.groups)
    for (size_t at = 0; at < group.pieces.size(); at += per_run) {
      const std::span<const Index> some = group.pieces.subspan(at, std::min(per_run, group.pieces.size() - at));
      const std::span<const Index> slots = blocks.slots(group.block);
      runs.push_back({next, some, pieces.pattern(some[0]).num_slots, slots});
      next += std::ssize(some) * std::ssize(slots);
    }
  std::vector<std::int32_t> columns(size_t(next) + alone.size());
  parallel_for_blocks(
      std::int64_t(runs.size()),
      [&](std::int64_t r, std::int64_t, std::int64_t) {
        std::int32_t* out = columns.data() + runs[r].first;
        if (std::ssize(runs[r].slots) == runs[r].num_points) {
          for (const Index piece : runs[r].pieces) out = pieces.points(piece, out);
          return;
        }
        std::vector<Index> all(size_t(runs[r].num_points));
        for (const Index piece : runs[r].pieces) {
          pieces.points(piece, all.data());
          for (const Index slot : runs[r].slots) *out++ = all[slot];
        }
      },
      1);
  std::copy(alone.begin(), alone.end(), columns.begin() + next);
  return columns;
}

}  // namespace sublimit
