// SPDX-License-Identifier: Apache-2.0
// Lists of places. Those on one address that follow each other in the list are a patch; the places that faces of one
// type have are the rows of its block.
#include <algorithm>
#include <bit>
#include <limits>
#include <span>
#include <unordered_map>

#include "sublimit/base/detail/memory.h"
#include "sublimit/stencils/bake/detail/bake_patterns.h"
#include "sublimit/stencils/bake/detail/bake_rows.h"
#include "sublimit/stencils/bake/detail/pattern_counts.h"
#include "sublimit/stencils/patterns/point_status.h"

namespace sublimit {
namespace {

/// Whether blocks are better than rows: they take at most half of the bytes, and are applied as fast, about. A run
/// costs as much as two places by rows, whatever it has, and a group as much as four more.
bool pays(const BakeStatistics& s, std::int64_t num_runs, std::int64_t bytes_by_rows) {
  return 2 * s.bytes <= bytes_by_rows && 2 * num_runs + 4 * std::int64_t{s.groups} <= s.points;
}

/// Places of a list that follow each other on one address.
struct Run {
  Index piece = 0;         ///< number of the address among those that have places
  std::int64_t first = 0;  ///< place
  std::int32_t count = 0;
};

struct Runs {
  std::vector<Index> addresses;  ///< that have places, ascending
  std::vector<Run> list;
};

Runs runs_of(std::span<const Place> samples, Index num_addresses) {
  Runs runs;
  std::vector<Index> piece(size_t(num_addresses), -1);
  for (const Place& s : samples) piece[s.face] = 0;
  for (Index a = 0; a < num_addresses; ++a) {
    if (piece[a] < 0) continue;
    piece[a] = static_cast<Index>(runs.addresses.size());
    runs.addresses.push_back(a);
  }
  for (std::int64_t i = 0; i < std::ssize(samples); ++i)
    if (i > 0 && samples[i].face == samples[i - 1].face)
      ++runs.list.back().count;
    else
      runs.list.push_back({piece[samples[i].face], i, 1});
  return runs;
}

/// Rows of blocks: the places that its addresses have, each once.
class PlaceRows {
 public:
  explicit PlaceRows(Index num_blocks) : places_(size_t(num_blocks)) {}
  std::int32_t add(Index block, const Place& s) {
    const Key key{block, std::bit_cast<std::uint64_t>(s.u + 0.0), std::bit_cast<std::uint64_t>(s.v + 0.0)};
    std::vector<AddressParameters>& own = places_[block];
    const auto [at, is_new] = numbers_.try_emplace(key, static_cast<std::int32_t>(own.size()));
    if (is_new) own.push_back({s.u, s.v});
    return at->second;
  }
  const std::vector<AddressParameters>& of(Index block) const { return places_[block]; }

 private:
  struct Key {
    Index block;
    std::uint64_t u, v;
    bool operator==(const Key&) const = default;
  };
  struct Hash {
    size_t operator()(const Key& k) const {
      std::uint64_t h = k.u * 0x9e3779b97f4a7c15u ^ std::rotl(k.v * 0xc2b2ae3d27d4eb4fu, 31) ^ std::uint64_t(k.block);
      h = (h ^ h >> 32) * 0x9e3779b97f4a7c15u;
      return size_t(h ^ h >> 29);
    }
  };
  std::unordered_map<Key, std::int32_t, Hash> numbers_;
  std::vector<std::vector<AddressParameters>> places_;
};

/// Runs that make the same rows of the same block.
class RunGroups {
 public:
  struct Key {
    Index block = 0;
    bool is_hole = false;
    std::span<const std::int32_t> rows;
    bool operator==(const Key& k) const {
      return block == k.block && is_hole == k.is_hole && std::ranges::equal(rows, k.rows);
    }
  };
  struct Group {
    Key key;
    std::int64_t num_runs = 0;
  };
  void add(const Key& key) {
    if (list_.empty() || !(list_[last_].key == key)) {
      const auto [at, is_new] = numbers_.try_emplace(key, list_.size());
      if (is_new) list_.push_back({key});
      last_ = at->second;
    }
    ++list_[last_].num_runs;
    of_run_.push_back(last_);
  }
  const std::vector<Group>& list() const { return list_; }
  /// Those that were added, group by group, in their order.
  std::vector<Run> sorted(const std::vector<Run>& runs) const {
    std::vector<size_t> next(list_.size(), 0);
    for (size_t g = 1; g < list_.size(); ++g) next[g] = next[g - 1] + size_t(list_[g - 1].num_runs);
    std::vector<Run> result(runs.size());
    for (size_t i = 0; i < runs.size(); ++i) result[next[of_run_[i]]++] = runs[i];
    return result;
  }

 private:
  struct Hash {
    size_t operator()(const Key& key) const {
      size_t h = size_t(key.block) * 2 + key.is_hole;
      for (const std::int32_t row : key.rows) h = (h ^ size_t(row) ^ h >> 29) * 0x9e3779b97f4a7c15u;
      return h ^ h >> 32;
    }
  };
  std::unordered_map<Key, size_t, Hash> numbers_;
  std::vector<Group> list_;
  std::vector<size_t> of_run_;
  size_t last_ = 0;
};

}  // namespace

std::optional<Baked> bake_places(Patterns& patterns, const Level& control, const BakeRequest& request,
                                 const PatternBake& how) {
  const Scheme<double>& scheme = patterns.scheme();
  const Topology& t = control.topology();
  if (!scheme.preparation.empty() && t.uniform_face_size() != scheme.corners) return std::nullopt;
  const std::vector<Place>& samples = request.samples;
  if (samples.empty() || samples.size() > size_t(std::numeric_limits<std::int32_t>::max())) return std::nullopt;
  const Addresses addresses(t, scheme.face_size() == 3);
  for (const Place& s : samples) check_inside(addresses, s);
  const Runs runs = runs_of(samples, addresses.size());
  const auto piece_at = [&](Index i) { return piece_of(scheme, t, addresses, runs.addresses[i]); };
  const PieceMatches pieces(patterns, control, static_cast<Index>(runs.addresses.size()), piece_at);
  PatternBlocks blocks(scheme);
  std::vector<Index> block_of(runs.addresses.size());
  for (Index i = 0; i < pieces.count(); ++i)
    block_of[i] = blocks.add({&pieces.pattern(i), {0, static_cast<std::int8_t>(pieces.turn(i)), -1}}, i);
  PlaceRows places(blocks.count());
  std::vector<std::int32_t> row_of(samples.size());
  for (const Run& run : runs.list)
    for (std::int64_t i = run.first; i < run.first + run.count; ++i)
      row_of[i] = places.add(block_of[run.piece], samples[i]);

  // Groups: runs of the same rows of the same block, in the order in which they are met.
  const auto is_hole = [&](const Run& run) {
    return bool(control.holes[index(addresses.place(runs.addresses[run.piece]).face)]);
  };
  RunGroups groups;
  for (const Run& run : runs.list)
    groups.add({block_of[run.piece], is_hole(run), std::span(row_of).subspan(size_t(run.first), size_t(run.count))});

  Baked baked;
  PatternTable<double>::Arrays arrays;
  arrays.quantities = num_quantities(request.derivatives);
  std::vector<std::int32_t> rows;
  for (const RunGroups::Group& group : groups.list()) {
    arrays.groups.push_back(
        {group.key.block, static_cast<std::int32_t>(group.key.rows.size()), std::ssize(rows), group.num_runs});
    rows.insert(rows.end(), group.key.rows.begin(), group.key.rows.end());
  }
  const std::vector<Run> list = groups.sorted(runs.list);
  std::int64_t columns = 0, slots = 0;
  for (const Run& run : list) {
    columns += pieces.pattern(run.piece).num_slots;
    slots += std::int64_t{run.count} * pieces.pattern(run.piece).num_slots;
  }
  const auto rows_of_block = [&](Index b) { return std::int64_t(arrays.quantities) * std::ssize(places.of(b)); };
  BakeStatistics& s = baked.statistics;
  s.faces = pieces.count();
  s.types = num_types(pieces);
  s.blocks = blocks.count();
  s.groups = static_cast<Index>(arrays.groups.size());
  s.points = std::ssize(samples);
  s.weights = static_cast<std::int64_t>(blocks.num_bytes(rows_of_block)) / std::int64_t(sizeof(double));
  s.bytes = std::int64_t(sizeof(double)) * s.weights + 4 * (std::ssize(rows) + columns) + 8 * std::ssize(list) +
            std::int64_t(sizeof(PatternTable<double>::Block)) * s.blocks +
            std::int64_t(sizeof(PatternTable<double>::Group)) * s.groups;
  const std::int64_t bytes_by_rows = arrays.quantities * (8 * s.points + 12 * slots);
  if (request.method == BakeMethod::automatic && !pays(s, std::ssize(list), bytes_by_rows)) return std::nullopt;
  check_memory("weights of " + std::to_string(s.points) + " places", 4.0 * double(s.bytes), "use fewer places");
  if (how.only_count) return baked;

  std::vector<std::optional<Patterns::LimitBlock>> made(size_t(blocks.count()));
  const bool all = blocks.fill(
      arrays, [&](Index b) { return static_cast<std::int32_t>(places.of(b).size()); },
      [&](Index b) -> const RowMatrix* {
        const auto& [pattern, place] = blocks.keys()[b];
        const Index i = blocks.piece(b);
        made[b] = patterns.limits_at(*pattern, {control, piece_at(i), pieces.turn(i)}, place, places.of(b),
                                     request.derivatives);
        return made[b] ? &made[b]->weights : nullptr;
      });
  if (!all) return std::nullopt;

  std::vector<std::uint8_t> row_status;
  for (size_t g = 0; g < arrays.groups.size(); ++g) {
    const auto& group = arrays.groups[g];
    for (std::int64_t k = group.rows; k < group.rows + group.num_rows; ++k) {
      const std::uint8_t status = made[group.block]->status[rows[k]];
      row_status.push_back(groups.list()[g].key.is_hole ? in_hole(status) : status);
    }
  }
  std::vector<std::int64_t> patch_points;
  std::vector<std::int32_t> all_columns;
  std::vector<Index> vertices;
  for (const Run& run : list) {
    patch_points.push_back(run.first);
    vertices.resize(size_t(pieces.pattern(run.piece).num_slots));
    pieces.points(run.piece, vertices.data());
    for (const Index slot : blocks.slots(block_of[run.piece])) all_columns.push_back(vertices[slot]);
  }
  arrays.rows = std::move(rows);
  arrays.columns = std::move(all_columns);
  arrays.patch_points = std::move(patch_points);
  if (std::any_of(row_status.begin(), row_status.end(), [](std::uint8_t status) { return status != 0; }))
    baked.table.row_status = std::move(row_status);
  baked.table.table = PatternTable<double>(t.num_vertices(), std::move(arrays));
  set_samples(request, baked);
  return baked;
}

}  // namespace sublimit
