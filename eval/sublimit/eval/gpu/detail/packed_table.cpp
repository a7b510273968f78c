// SPDX-License-Identifier: Apache-2.0
#include "sublimit/eval/gpu/detail/packed_table.h"

#include <algorithm>
#include <map>
#include <string>
#include <unordered_map>
#include <utility>

#include "sublimit/base/error.h"

namespace sublimit::gpu {
namespace {

constexpr std::int64_t rows_of_slice = 32;
/// Points of patches that pay for threads of four rows: of a group, and of all of these groups, which take a launch
/// more.
constexpr std::int64_t points_of_group = 256, points_of_launch = 1 << 17;
/// Patches of one tile, where few are made at a time: of more, shared memory would hold fewer columns at once, and each
/// time the workgroup waits for the next ones.
constexpr std::int64_t few_at_once = 32;
/// Made together.
constexpr int quantities_of[] = {1, 3, 6};

/// Columns that a kernel multiplies at a time.
constexpr std::int64_t columns_at_a_time(int rows_of_thread) { return rows_of_thread == 1 ? 8 : 4; }

/// Rows of one group that a tile has, and their weights.
struct Rows {
  std::int64_t first = 0, count = 0, weights = 0, stride = 0;  ///< as `Tile` has them
};

/// Weights of groups as `apply_patches` reads them. Groups with the same rows of a block share them.
class PackedWeights {
 public:
  explicit PackedWeights(const Arrays& a) : a_(a) {}
  /// @param rows_of_thread  1, or 4 that lie as far apart as there are threads for them
  const std::vector<Rows>& rows(const PatternTable<float>::Group& group, int rows_of_thread) {
    const auto [found, is_new] = packed_.try_emplace({rows_of_thread, rows_key(a_, group)});
    if (is_new) found->second = pack(group, rows_of_thread);
    return found->second;
  }
  std::vector<float> weights;

 private:
  std::vector<Rows> pack(const PatternTable<float>::Group& group, int rows_of_thread) {
    const std::int64_t columns = a_.blocks[size_t(group.block)].columns,
                       padded = rounded_up(columns, columns_at_a_time(rows_of_thread));
    check_weights(std::ssize(weights), group.num_rows * padded, a_.quantities);
    std::vector<Rows> all;
    for (std::int64_t first = 0; first < group.num_rows; first += threads * rows_of_thread) {
      const std::int64_t count = std::min<std::int64_t>(threads * rows_of_thread, group.num_rows - first),
                         units = (count + rows_of_thread - 1) / rows_of_thread,
                         stride = rounded_up(units * rows_of_thread, 4);
      all.push_back({first, count, std::ssize(weights) / 4, stride / 4});
      weights.resize(number(std::ssize(weights) + stride * padded * a_.quantities, "weights"));
      float* const out = weights.data() + 4 * all.back().weights;
      for (int q = 0; q < a_.quantities; ++q)
        for (std::int64_t row = 0; row < count; ++row) {
          const float* const from = row_of(a_, group, first + row, q);
          const std::int64_t at = row % units * rows_of_thread + row / units;
          for (std::int64_t k = 0; k < columns; ++k) out[(q * padded + k) * stride + at] = from[k];
        }
    }
    return all;
  }

  const Arrays& a_;
  std::map<std::pair<int, std::vector<std::int32_t>>, std::vector<Rows>> packed_;
};

/// Which groups are for threads of four rows.
std::vector<bool> groups_of_many(const Arrays& a) {
  std::vector<bool> many;
  std::int64_t points = 0;
  for (const auto& group : a.groups) {
    const std::int64_t made = group.num_rows * group.num_patches;
    many.push_back(made >= points_of_group && 2 * rounded_up(group.num_rows, 4) <= std::int64_t{3} * group.num_rows);
    if (many.back()) points += made;
  }
  if (points < points_of_launch) many.assign(many.size(), false);
  return many;
}

/// That patches with places make all points: what is copied back to the host is all of it made.
void check_places(const PatternTable<float>& table) {
  const auto& a = table.arrays();
  if (a.patch_points.empty()) return;
  std::vector<bool> made(size_t(table.starts().back().point));
  for (size_t g = 0; g < a.groups.size(); ++g)
    for (std::int64_t patch = table.starts()[g].patch; patch < table.starts()[g + 1].patch; ++patch) {
      const std::int64_t begin = a.patch_points[patch], end = begin + a.groups[g].num_rows;
      for (std::int64_t point = begin; point < std::min(end, std::ssize(made)); ++point) made[size_t(point)] = true;
    }
  if (const auto missing = std::find(made.begin(), made.end(), false); missing != made.end())
    throw InvalidParameter("a table that makes no point " + std::to_string(missing - made.begin()) +
                           " cannot be applied on a GPU; make every point once");
}

void pack_patches(const PatternTable<float>& table, PackedTable& out) {
  const auto& a = table.arrays();
  if (table.num_patches() == 0) return;
  PackedWeights packed(a);
  std::array<std::array<std::vector<Tile>, 2>, 3> tiles;
  const std::vector<bool> groups_with_many = groups_of_many(a);
  for (size_t g = 0; g < a.groups.size(); ++g) {
    const auto& group = a.groups[g];
    const auto& start = table.starts()[g];
    const std::int64_t columns = a.blocks[size_t(group.block)].columns;
    const bool many = groups_with_many[g];
    if (group.num_patches == 0 || group.num_rows == 0) continue;
    for (const Rows& rows : packed.rows(group, shape_of(1, many).rows))
      for (size_t size = 0; size < 3 && quantities_of[size] <= a.quantities; ++size) {
        const Shape shape = shape_of(quantities_of[size], many);
        const std::int64_t units = (rows.count + shape.rows - 1) / shape.rows, most = threads / units * shape.patches,
                           at_once = many ? most : std::min(most, few_at_once);
        for (std::int64_t patch = 0; patch < group.num_patches; patch += at_once)
          tiles[size][many].push_back({.weights = uint(rows.weights),
                                       .stride = uint(rows.stride),
                                       .num_columns = uint(columns),
                                       .columns = number(start.columns + patch * columns, "columns of patches"),
                                       .num_patches = uint(std::min(at_once, group.num_patches - patch)),
                                       .first_patch = number(start.patch + patch, "patches"),
                                       .first_point = uint(start.point + patch * group.num_rows),
                                       .rows_of_patch = uint(group.num_rows),
                                       .first_row = uint(rows.first),
                                       .num_rows = uint(rows.count)});
      }
  }
  number(std::int64_t(a.columns.size()), "columns of patches");
  Image& image = out.image;
  const std::int64_t weights = image.add<float>(packed.weights), columns = image.add<std::int32_t>(a.columns.span()),
                     patch_points = pack_patch_points(a, image);
  for (size_t size = 0; size < 3; ++size)
    for (const bool many : {false, true}) {
      if (tiles[size][many].empty()) continue;
      const PatchTable empty = {};
      Part& part = out.patches[size][many];
      part = {image.add(std::span(&empty, 1)), std::ssize(tiles[size][many])};
      image.set_address(part.table, offsetof(PatchTable, tiles), image.add<Tile>(tiles[size][many]));
      image.set_address(part.table, offsetof(PatchTable, weights), weights);
      image.set_address(part.table, offsetof(PatchTable, columns), columns);
      if (patch_points >= 0) image.set_address(part.table, offsetof(PatchTable, patch_points), patch_points);
    }
}

/// Rows of quantity after quantity, slices of 32 side by side.
Part pack_rows(const StencilTable<float>& table, int quantities, std::int64_t first_point, Image& image) {
  const std::int64_t count = table.num_rows() / quantities, padded = rounded_up(count, rows_of_slice);
  if (count == 0) return {};
  struct Entry {
    std::int32_t column;
    float weight;
  };
  std::vector<std::uint32_t> slices, lengths(size_t(padded * quantities));
  std::vector<Entry> entries;
  for (int q = 0; q < quantities; ++q)
    for (std::int64_t begin = 0; begin < padded; begin += rows_of_slice) {
      const std::int64_t end = std::min(count, begin + rows_of_slice), at = std::int64_t(entries.size());
      std::int64_t longest = 0;
      for (std::int64_t i = begin; i < end; ++i) {
        const std::int64_t row = q * count + i, length = table.offsets()[row + 1] - table.offsets()[row];
        lengths[size_t(q * padded + i)] = number(length, "entries of a row");
        longest = std::max(longest, length);
      }
      slices.push_back(number(at, "entries of rows"));
      number(at + longest * rows_of_slice, "entries of rows");
      entries.resize(size_t(at + longest * rows_of_slice));
      for (std::int64_t i = begin; i < end; ++i) {
        const std::int64_t row = q * count + i;
        for (std::int64_t k = table.offsets()[row]; k < table.offsets()[row + 1]; ++k)
          entries[size_t(at + (k - table.offsets()[row]) * rows_of_slice + i - begin)] = {table.columns()[k],
                                                                                          table.weights()[k]};
      }
    }
  const RowTable header = {.slices = 0,
                           .lengths = 0,
                           .entries = 0,
                           .first_point = number(first_point, "points"),
                           .quantity = number(padded * quantities, "rows") / uint(quantities)};
  const Part part{image.add(std::span(&header, 1)), count};
  image.set_address(part.table, offsetof(RowTable, slices), image.add<std::uint32_t>(slices));
  image.set_address(part.table, offsetof(RowTable, lengths), image.add<std::uint32_t>(lengths));
  image.set_address(part.table, offsetof(RowTable, entries), image.add<Entry>(entries));
  return part;
}

/// Pairs as if they had been copied one after the other; none reads what another writes, so that all can be at once.
Part pack_copies(std::span<const std::int32_t> pairs, Image& image) {
  std::unordered_map<std::int32_t, std::int32_t>
      source;  // of points that are written: the point that was there before all
  std::vector<std::int32_t> order;
  for (size_t i = 0; i + 1 < pairs.size(); i += 2) {
    const auto known = source.find(pairs[i + 1]);
    const std::int32_t from = known == source.end() ? pairs[i + 1] : known->second;
    if (source.insert_or_assign(pairs[i], from).second) order.push_back(pairs[i]);
  }
  std::vector<std::int32_t> resolved;
  for (const std::int32_t to : order) {
    const std::int32_t from = source.at(to);
    if (from == to) continue;
    if (const auto written = source.find(from); written != source.end() && written->second != from)
      throw InvalidParameter("a table whose copies take point " + std::to_string(from) +
                             " and then write it cannot be applied on a GPU; copy it last");
    resolved.insert(resolved.end(), {to, from});
  }
  if (resolved.empty()) return {};
  const CopyTable empty = {};
  const Part part{image.add(std::span(&empty, 1)), std::int64_t(resolved.size() / 2)};
  image.set_address(part.table, offsetof(CopyTable, pairs), image.add<std::int32_t>(resolved));
  return part;
}

}  // namespace

PackedTable::PackedTable(const PatternTable<float>& table) {
  const auto& a = table.arrays();
  number(table.num_points(), "points");
  check_places(table);
  pack_patches(table, *this);
  if (a.first) first = pack_rows(*a.first, 1, 0, image);
  if (a.rest) rest = pack_rows(*a.rest, a.quantities, table.num_points() - a.rest->num_rows() / a.quantities, image);
  copies = pack_copies(a.copies.span(), image);
}

}  // namespace sublimit::gpu
