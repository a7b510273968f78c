// SPDX-License-Identifier: Apache-2.0
#include "sublimit/patterns/patch_groups.h"

#include <algorithm>
#include <tuple>
#include <unordered_map>

#include "sublimit/base/parallel_for.h"

namespace sublimit {

PatchGroups::PatchGroups(const PieceMatches& pieces, std::span<const Index> block,
                         std::span<const std::uint8_t> share) {
  const Index count = pieces.count();
  std::unordered_map<std::int64_t, Index> numbers;
  std::int64_t last = -1;
  Index number = -1;
  for (Index i = 0; i < count; ++i) {
    if (block[i] < 0) continue;
    const std::int64_t key = std::int64_t{block[i]} * 256 + share[i];
    if (key != last) {
      const auto [at, is_new] = numbers.try_emplace(key, static_cast<Index>(groups.size()));
      if (is_new) groups.push_back({block[i], share[i], {}});
      number = at->second;
      last = key;
    }
    groups[number].pieces.push_back(i);
  }
  std::sort(groups.begin(), groups.end(),
            [](const Group& a, const Group& b) { return std::tie(a.block, a.share) < std::tie(b.block, b.share); });
}

std::vector<std::int32_t> all_columns(const PieceMatches& pieces, const PatternBlocks& blocks,
                                      const PatchGroups& groups, std::span<const Index> alone) {
  struct Run {
    std::int64_t first;  // where its control points begin
    const Index* pieces;
    std::int64_t count;
    std::span<const Index> slots;
  };
  constexpr std::int64_t per_run = 1024;
  std::vector<Run> runs;
  std::int64_t next = 0;
  for (const PatchGroups::Group& group : groups.groups)
    for (size_t at = 0; at < group.pieces.size(); at += per_run) {
      const std::int64_t count = std::min<std::int64_t>(per_run, std::int64_t(group.pieces.size() - at));
      const std::span<const Index> slots = blocks.slots(group.block);
      runs.push_back({next, group.pieces.data() + at, count, slots});
      next += count * std::ssize(slots);
    }
  std::vector<std::int32_t> columns(size_t(next) + alone.size());
  parallel_for_blocks(
      std::int64_t(runs.size()),
      [&](std::int64_t r, std::int64_t, std::int64_t) {
        std::int32_t* out = columns.data() + runs[r].first;
        for (std::int64_t i = 0; i < runs[r].count; ++i) {
          const std::span<const Index> vertices = pieces.vertices(runs[r].pieces[i]);
          if (runs[r].slots.size() == vertices.size())
            out = std::copy(vertices.begin(), vertices.end(), out);
          else
            for (const Index slot : runs[r].slots) *out++ = vertices[slot];
        }
      },
      1);
  std::copy(alone.begin(), alone.end(), columns.begin() + next);
  return columns;
}

}  // namespace sublimit
