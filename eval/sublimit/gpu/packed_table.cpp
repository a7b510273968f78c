// SPDX-License-Identifier: Apache-2.0
#include "sublimit/gpu/packed_table.h"

#include <algorithm>
#include <limits>
#include <map>
#include <string>
#include <unordered_map>

#include "sublimit/base/error.h"

namespace sublimit::gpu {
namespace {

constexpr std::int64_t rows_of_slice = 32;
/// Points of patches that pay for threads of four rows: of a group, and of all of these groups, which take a launch
/// more.
constexpr std::int64_t points_of_group = 256, points_of_launch = 1 << 17;
/// Columns of patches that a workgroup of a transpose takes.
constexpr std::int64_t items_at_once = 256;
/// Patches of one tile, where few are made at a time: of more, shared memory would hold fewer columns at once, and each
/// time the workgroup waits for the next ones.
constexpr std::int64_t few_at_once = 32;
/// Made together.
constexpr int quantities_of[] = {1, 3, 6};

std::uint32_t number(std::int64_t value, const char* what) {
  if (value < 0 || value > std::numeric_limits<std::int32_t>::max())
    throw ResourceError("tables on a GPU count up to 2147483647 " + std::string(what) + ", not " +
                        std::to_string(value) + "; cut the table into several, or apply it on the CPU");
  return static_cast<std::uint32_t>(value);
}

std::int64_t rounded_up(std::int64_t value, std::int64_t multiple) {
  return (value + multiple - 1) / multiple * multiple;
}

/// Columns that a kernel multiplies at a time.
constexpr std::int64_t columns_at_a_time(int rows_of_thread) { return rows_of_thread == 1 ? 8 : 4; }

using Arrays = PatternTable<float>::Arrays;

/// A row of the block of a group, for one quantity.
const float* row_of(const Arrays& a, const PatternTable<float>::Group& group, std::int64_t row, int quantity) {
  const auto& block = a.blocks[size_t(group.block)];
  return a.weights.data() + block.weights +
         (std::int64_t{quantity} * block.rows + a.rows[group.rows + row]) * block.columns;
}

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
    std::vector<std::int32_t> key{group.block, rows_of_thread};
    const auto chosen = a_.rows.span().subspan(size_t(group.rows), size_t(group.num_rows));
    key.insert(key.end(), chosen.begin(), chosen.end());
    const auto [found, is_new] = packed_.try_emplace(std::move(key));
    if (is_new) found->second = pack(group, rows_of_thread);
    return found->second;
  }
  std::vector<float> weights;

 private:
  std::vector<Rows> pack(const PatternTable<float>::Group& group, int rows_of_thread) {
    const std::int64_t columns = a_.blocks[size_t(group.block)].columns,
                       padded = rounded_up(columns, columns_at_a_time(rows_of_thread));
    std::vector<Rows> all;
    for (std::int64_t first = 0; first < group.num_rows; first += threads * rows_of_thread) {
      const std::int64_t count = std::min<std::int64_t>(threads * rows_of_thread, group.num_rows - first),
                         units = (count + rows_of_thread - 1) / rows_of_thread,
                         stride = rounded_up(units * rows_of_thread, 4);
      all.push_back({first, count, number(std::ssize(weights), "weights") / 4, stride / 4});
      weights.resize(weights.size() + size_t(stride * padded * a_.quantities));
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
  std::map<std::vector<std::int32_t>, std::vector<Rows>> packed_;
};

/// Which groups are for threads of four rows.
std::vector<bool> groups_of_many(const Arrays& a) {
  std::vector<bool> many;
  std::int64_t points = 0;
  for (const auto& group : a.groups) {
    const std::int64_t made = group.num_rows * group.num_patches;
    many.push_back(made >= points_of_group && 2 * rounded_up(group.num_rows, 4) <= 3 * group.num_rows);
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

/// Where the points of each patch begin; -1: they follow those of the patch before.
std::int64_t pack_patch_points(const PatternTable<float>::Arrays& a, Image& image) {
  if (a.patch_points.empty()) return -1;
  const std::vector<std::uint32_t> places(a.patch_points.begin(), a.patch_points.end());
  return image.add<std::uint32_t>(places);
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
  number(std::ssize(packed.weights), "weights");
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

/// Where each number occurs in a list, ascending: those of number i are places[offsets[i]] .. places[offsets[i + 1] -
/// 1].
struct Occurrences {
  std::vector<std::uint32_t> offsets, places;
  Occurrences(std::int64_t count, std::span<const std::int32_t> numbers)
      : offsets(size_t(count) + 1), places(numbers.size()) {
    for (const std::int32_t n : numbers) ++offsets[size_t(n) + 1];
    for (size_t i = 1; i < offsets.size(); ++i) offsets[i] += offsets[i - 1];
    std::vector<std::uint32_t> next(offsets.begin(), offsets.end() - 1);
    for (size_t at = 0; at < numbers.size(); ++at) places[next[size_t(numbers[at])]++] = uint(at);
  }
};

/// What each of `count` inputs gets: parts that name it, and entries of rows.
/// @param value_of  the number of a row's value
template <class ValueOf>
Part pack_gather(std::int64_t count, std::span<const std::int32_t> parts, const StencilTable<float>* rows,
                 const ValueOf& value_of, Image& image) {
  const GatherTable empty = {};
  const Part part{image.add(std::span(&empty, 1)), count};
  if (!parts.empty()) {
    const Occurrences uses(count, parts);
    image.set_address(part.table, offsetof(GatherTable, part_offsets), image.add<std::uint32_t>(uses.offsets));
    image.set_address(part.table, offsetof(GatherTable, parts), image.add<std::uint32_t>(uses.places));
  }
  if (rows && !rows->columns().empty()) {
    number(std::int64_t(rows->columns().size()), "entries of rows");
    const Occurrences uses(count, rows->columns().span());
    std::vector<std::uint32_t> value(rows->columns().size());
    for (std::int64_t row = 0; row < rows->num_rows(); ++row)
      std::fill(value.begin() + rows->offsets()[row], value.begin() + rows->offsets()[row + 1],
                number(value_of(row), "values"));
    struct Entry {
      std::uint32_t value;
      float weight;
    };
    std::vector<Entry> entries;
    for (const std::uint32_t at : uses.places) entries.push_back({value[at], rows->weights()[at]});
    image.set_address(part.table, offsetof(GatherTable, entry_offsets), image.add<std::uint32_t>(uses.offsets));
    image.set_address(part.table, offsetof(GatherTable, entries), image.add<Entry>(entries));
  }
  return part;
}

/// Which values each point has in the end: a copy gives what it gets to its source, last ones first.
Part pack_fold(const PatternTable<float>& table, Image& image) {
  const auto& pairs = table.arrays().copies;
  if (pairs.empty()) return {};
  constexpr std::int64_t none = -1;
  const auto count = size_t(table.num_points());
  std::vector<std::int64_t> next(count, none), first(count), last(count);  // lists of values
  for (size_t i = 0; i < count; ++i) first[i] = last[i] = std::int64_t(i);
  for (std::int64_t i = std::int64_t(pairs.size()) - 2; i >= 0; i -= 2) {
    const auto to = size_t(pairs[i]), from = size_t(pairs[i + 1]);
    if (to == from || first[to] == none) continue;
    (first[from] == none ? first[from] : next[size_t(last[from])]) = first[to];
    last[from] = last[to];
    first[to] = none;
  }
  std::vector<std::uint32_t> offsets{0}, points;
  for (size_t i = 0; i < count; ++i) {
    for (std::int64_t at = first[i]; at != none; at = next[size_t(at)]) points.push_back(uint(at));
    offsets.push_back(uint(points.size()));
  }
  const FoldTable empty = {};
  const Part part{image.add(std::span(&empty, 1)), std::int64_t(count)};
  image.set_address(part.table, offsetof(FoldTable, offsets), image.add<std::uint32_t>(offsets));
  image.set_address(part.table, offsetof(FoldTable, points), image.add<std::uint32_t>(points));
  return part;
}

/// Columns of patches, for the sums that they get.
Part pack_transposed(const PatternTable<float>& table, Image& image) {
  const auto& a = table.arrays();
  std::vector<Group> groups;
  std::vector<Items> items;
  std::vector<float> weights;
  for (size_t g = 0; g < a.groups.size(); ++g) {
    const auto& group = a.groups[g];
    const auto& start = table.starts()[g];
    const std::int64_t columns = a.blocks[size_t(group.block)].columns;
    groups.push_back({.weights = number(std::ssize(weights), "weights"),
                      .stride = uint(group.num_rows),
                      .num_columns = uint(columns),
                      .columns = number(start.columns, "columns of patches"),
                      .num_rows = uint(group.num_rows),
                      .first_point = uint(start.point),
                      .first_patch = number(start.patch, "patches")});
    for (int q = 0; q < a.quantities; ++q)
      for (std::int64_t k = 0; k < columns; ++k)
        for (std::int64_t row = 0; row < group.num_rows; ++row) weights.push_back(row_of(a, group, row, q)[k]);
    for (std::int64_t first = 0; first < group.num_patches * columns; first += items_at_once)
      items.push_back({uint(g), number(first, "columns of patches"),
                       uint(std::min(items_at_once, group.num_patches * columns - first))});
  }
  number(std::ssize(weights), "weights");
  const TransposeTable empty = {};
  const Part part{image.add(std::span(&empty, 1)), std::ssize(items)};
  image.set_address(part.table, offsetof(TransposeTable, items), image.add<Items>(items));
  image.set_address(part.table, offsetof(TransposeTable, groups), image.add<Group>(groups));
  image.set_address(part.table, offsetof(TransposeTable, weights), image.add<float>(weights));
  if (const std::int64_t places = pack_patch_points(a, image); places >= 0)
    image.set_address(part.table, offsetof(TransposeTable, patch_points), places);
  return part;
}

}  // namespace

std::int64_t Image::add_bytes(std::span<const std::byte> bytes) {
  bytes_.resize(size_t(rounded_up(num_bytes(), 64)));
  const std::int64_t at = num_bytes();
  bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
  return at;
}

std::span<const std::byte> Image::at(std::uint64_t address) {
  for (const auto& [at, target] : addresses_) {
    const std::uint64_t value = address + std::uint64_t(target);
    std::memcpy(bytes_.data() + at, &value, sizeof value);
  }
  return bytes_;
}

PackedTable::PackedTable(const PatternTable<float>& table) {
  const auto& a = table.arrays();
  number(table.num_points(), "points");
  check_places(table);
  pack_patches(table, *this);
  if (a.first) first = pack_rows(*a.first, 1, 0, image);
  if (a.rest) rest = pack_rows(*a.rest, a.quantities, table.num_points() - a.rest->num_rows() / a.quantities, image);
  copies = pack_copies(a.copies.span(), image);
}

PackedTranspose::PackedTranspose(const PatternTable<float>& table) {
  const auto& a = table.arrays();
  const std::int64_t num_inputs = a.first ? a.first->num_rows() : table.num_control_points(),
                     num_rest = a.rest ? a.rest->num_rows() / a.quantities : 0;
  number(table.num_points() * a.quantities, "values");
  num_parts = std::int64_t(a.columns.size());
  fold = pack_fold(table, image);
  if (num_parts > 0) patches = pack_transposed(table, image);
  const std::int64_t before_rest = table.num_points() - num_rest;
  inputs = pack_gather(
      num_inputs, a.columns.span(), a.rest ? &*a.rest : nullptr,
      [&](std::int64_t row) { return row / num_rest * table.num_points() + before_rest + row % num_rest; }, image);
  if (a.first)
    first = pack_gather(
        table.num_control_points(), {}, &*a.first, [](std::int64_t row) { return row; }, image);
}

}  // namespace sublimit::gpu
