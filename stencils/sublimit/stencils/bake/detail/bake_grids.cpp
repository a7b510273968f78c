// SPDX-License-Identifier: Apache-2.0
// The same places on every address: each has all of its points, and positions on sides are copied.
#include <algorithm>
#include <limits>

#include "sublimit/base/detail/memory.h"
#include "sublimit/stencils/bake/detail/bake_patterns.h"
#include "sublimit/stencils/bake/detail/bake_rows.h"
#include "sublimit/stencils/bake/detail/pattern_counts.h"
#include "sublimit/stencils/patterns/point_status.h"
#include "sublimit/surface/limit_map.h"

namespace sublimit {

std::optional<Baked> bake_grids(Patterns& patterns, const Level& control, const BakeRequest& request,
                                const PatternBake& how) {
  const Scheme<double>& scheme = patterns.scheme();
  const Topology& t = control.topology();
  if (!scheme.preparation.empty() && t.uniform_face_size() != scheme.corners) return std::nullopt;
  const Addresses addresses(t, scheme.face_size() == 3);
  const Lattice lattice{request.grid - 1, addresses.triangles()};
  Baked baked;
  PatternTable<double>::Arrays arrays;
  arrays.quantities = num_quantities(request.derivatives);
  if (double(addresses.size()) * lattice.size() > std::numeric_limits<std::int32_t>::max()) return std::nullopt;

  const auto piece_at = [&](Index address) { return piece_of(scheme, t, addresses, address); };
  const PieceMatches pieces(patterns, control, addresses.size(), piece_at);
  PatternBlocks blocks(scheme);
  std::vector<Index> block_of(addresses.size());
  std::vector<std::uint8_t> is_hole(addresses.size());
  for (Index a = 0; a < addresses.size(); ++a) {
    block_of[a] = blocks.add({&pieces.pattern(a), {a, static_cast<std::int8_t>(pieces.turn(a)), -1}}, a);
    is_hole[a] = control.holes[index(addresses.place(a).face)];
  }
  const auto rows_of_block = [&](Index) { return arrays.quantities * lattice.size(); };
  const double bytes = blocks.num_bytes(rows_of_block);
  if (bytes > how.most_bytes) return std::nullopt;
  check_memory(std::to_string(blocks.keys().size()) + " blocks of " + std::to_string(lattice.size()) + " places",
               4 * bytes, "use fewer places");
  const PatchGroups groups(pieces, block_of, is_hole);
  if (how.only_count) {
    BakeStatistics& s = baked.statistics;
    count(
        blocks, groups, rows_of_block, [&](const PatchGroups::Group&) { return lattice.size(); }, s);
    s.faces = addresses.size();
    s.types = num_types(pieces);
    s.bytes += 8 * (std::int64_t(pieces.count()) +
                    std::ssize(shared_grid_places(t, addresses, request.grid, scheme.is_dual())));
    return baked;
  }
  const auto limit_block = [&](Index b) {
    const auto& [pattern, place] = blocks.keys()[b];
    const Index a = blocks.piece(b);
    return patterns.limit_block(*pattern, {control, piece_at(a), pieces.turn(a)},
                                {lattice, place, true, request.derivatives});
  };
  const bool made = blocks.fill(
      arrays, [&](Index) { return lattice.size(); },
      [&](Index b) -> const RowMatrix* {
        const Patterns::LimitBlock* block = limit_block(b);
        return block ? &block->weights : nullptr;
      });
  if (!made) return std::nullopt;

  std::vector<std::int32_t> rows;
  std::vector<std::uint8_t> row_status;
  std::vector<std::int64_t> patch_points;
  for (const PatchGroups::Group& group : groups.groups) {
    arrays.groups.push_back(
        {group.block, lattice.size(), static_cast<std::int64_t>(rows.size()), std::int64_t(group.pieces.size())});
    for (const Index a : group.pieces) patch_points.push_back(std::int64_t{a} * lattice.size());
    for (std::int32_t i = 0; i < lattice.size(); ++i) rows.push_back(i);
    const std::vector<std::uint8_t>& status = limit_block(group.block)->status;
    for (const std::uint8_t s : status) row_status.push_back(group.share ? in_hole(s) : s);
  }
  arrays.rows = std::move(rows);
  arrays.columns = all_columns(pieces, blocks, groups, {});
  arrays.patch_points = std::move(patch_points);
  arrays.copies = grid_copies(t, addresses, request.grid, scheme.is_dual());
  if (std::any_of(row_status.begin(), row_status.end(), [](std::uint8_t s) { return s != 0; }))
    baked.table.row_status = std::move(row_status);
  baked.table.table = PatternTable<double>(t.num_vertices(), std::move(arrays));
  baked.statistics.faces = addresses.size();
  baked.statistics.types = num_types(pieces);
  return baked;
}

}  // namespace sublimit
