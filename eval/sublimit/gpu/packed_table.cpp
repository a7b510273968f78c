// SPDX-License-Identifier: Apache-2.0
#include "sublimit/gpu/packed_table.h"

#include <algorithm>
#include <bit>
#include <limits>
#include <string>
#include <unordered_map>

#include "sublimit/base/error.h"

namespace sublimit::gpu {
namespace {

constexpr std::int64_t rows_of_slice = 32;
/// Patches by fours of rows, if they fill so many workgroups.
constexpr std::int64_t points_of_many = 256;
/// Columns of patches that a workgroup of a transpose takes.
constexpr std::int64_t items_of_tile = 256;

std::uint32_t number(std::int64_t value, const char* what) {
  if (value < 0 || value > std::numeric_limits<std::uint32_t>::max())
    throw ResourceError("tables on a GPU count up to 4294967295 " + std::string(what) + ", not " +
                        std::to_string(value) + "; cut the table into several, or apply it on the CPU");
  return static_cast<std::uint32_t>(value);
}

std::int64_t rounded_up(std::int64_t value, std::int64_t multiple) {
  return (value + multiple - 1) / multiple * multiple;
}

/// Rows of a group, packed: column after column, by fours, all quantities.
void append_weights(const PatternTable<float>::Arrays& a, const PatternTable<float>::Group& group,
                    std::vector<float>& out) {
  const auto& block = a.blocks[size_t(group.block)];
  const std::int64_t stride = rounded_up(group.num_rows, 4);
  auto at = out.size();
  out.resize(at + size_t(stride * block.columns * a.quantities));
  for (int q = 0; q < a.quantities; ++q) {
    const float* const matrix = a.weights.data() + block.weights + q * std::int64_t{block.rows} * block.columns;
    for (std::int32_t k = 0; k < block.columns; ++k, at += size_t(stride))
      for (std::int32_t r = 0; r < group.num_rows; ++r)
        out[at + size_t(r)] = matrix[std::int64_t{a.rows[group.rows + r]} * block.columns + k];
  }
}

/// Rows that groups have in common are packed once.
class PackedWeights {
 public:
  explicit PackedWeights(const PatternTable<float>::Arrays& a) : a_(a) {}
  /// Where those of a group begin.
  std::int64_t place(const PatternTable<float>::Group& group) {
    const auto rows = a_.rows.span().subspan(size_t(group.rows), size_t(group.num_rows));
    std::uint64_t key = 0xcbf29ce484222325u ^ std::uint64_t(group.block);
    for (const std::int32_t row : rows) key = (key ^ std::uint64_t(row)) * 0x100000001b3u;
    const auto [begin, end] = places_.equal_range(key);
    for (auto it = begin; it != end; ++it) {
      const auto& other = a_.groups[it->second.group];
      if (other.block == group.block &&
          std::ranges::equal(rows, a_.rows.span().subspan(size_t(other.rows), size_t(other.num_rows))))
        return it->second.weights;
    }
    const auto at = std::int64_t(weights.size());
    append_weights(a_, group, weights);
    places_.insert({key, {size_t(&group - a_.groups.data()), at}});
    return at;
  }
  std::vector<float> weights;

 private:
  struct Place {
    size_t group;
    std::int64_t weights;
  };
  const PatternTable<float>::Arrays& a_;
  std::unordered_multimap<std::uint64_t, Place> places_;
};

/// Tiles of a group for threads of this shape.
void append_tiles(std::uint32_t g, const Group& group, std::int64_t num_patches, Shape shape, std::vector<Tile>& out) {
  const std::int64_t most_rows = threads * shape.rows;
  for (std::int64_t row = 0; row < group.num_rows; row += most_rows) {
    const std::int64_t rows = std::min(most_rows, group.num_rows - row), units = (rows + shape.rows - 1) / shape.rows,
                       at_once = threads / units * shape.patches;
    for (std::int64_t patch = 0; patch < num_patches; patch += at_once)
      out.push_back({g, uint(patch), uint(std::min(at_once, num_patches - patch)), uint(row), uint(rows)});
  }
}

bool are_many(const Group& group, std::int64_t num_patches) {
  return group.num_rows * num_patches >= points_of_many && 2 * rounded_up(group.num_rows, 4) <= 3 * group.num_rows;
}

/// Groups and their weights.
struct PackedGroups {
  std::vector<Group> groups;
  std::vector<float> weights;
};
PackedGroups pack_groups(const PatternTable<float>& table) {
  const auto& a = table.arrays();
  PackedWeights packed(a);
  std::vector<Group> groups;
  for (size_t g = 0; g < a.groups.size(); ++g) {
    const auto& group = a.groups[g];
    const auto& block = a.blocks[size_t(group.block)];
    const auto& start = table.starts()[g];
    const std::int64_t stride = rounded_up(group.num_rows, 4);
    groups.push_back({.weights = number(packed.place(group), "weights") / 4,
                      .stride = uint(stride / 4),
                      .quantity = number(stride / 4 * block.columns, "weights"),
                      .num_columns = uint(block.columns),
                      .columns = number(start.columns, "columns of patches"),
                      .num_rows = uint(group.num_rows),
                      .first_point = number(start.point, "points"),
                      .first_patch = number(start.patch, "patches")});
  }
  number(std::int64_t(packed.weights.size()), "weights");
  number(std::int64_t(a.columns.size()), "columns of patches");
  return {std::move(groups), std::move(packed.weights)};
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
  const auto [groups, packed] = pack_groups(table);
  Image& image = out.image;
  const std::int64_t group_array = image.add<Group>(groups), weights = image.add<float>(packed),
                     columns = image.add<std::int32_t>(a.columns.span()), patch_points = pack_patch_points(a, image);
  for (size_t size = 0; size < 3; ++size) {
    const int quantities = size == 0 ? 1 : size == 1 ? 3 : 6;
    if (quantities > a.quantities) break;
    for (const bool many : {false, true}) {
      std::vector<Tile> tiles;
      for (size_t g = 0; g < groups.size(); ++g)
        if (are_many(groups[g], a.groups[g].num_patches) == many)
          append_tiles(uint(g), groups[g], a.groups[g].num_patches, shape_of(quantities, many), tiles);
      if (tiles.empty()) continue;
      const std::int64_t tile_array = image.add<Tile>(tiles);
      const PatchTable empty = {};
      Part& part = out.patches[size][many];
      part = {image.add(std::span(&empty, 1)), std::int64_t(tiles.size())};
      image.set_address(part.table, offsetof(PatchTable, tiles), tile_array);
      image.set_address(part.table, offsetof(PatchTable, groups), group_array);
      image.set_address(part.table, offsetof(PatchTable, weights), weights);
      image.set_address(part.table, offsetof(PatchTable, columns), columns);
      if (patch_points >= 0) image.set_address(part.table, offsetof(PatchTable, patch_points), patch_points);
    }
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
                           .quantity = number(padded, "rows")};
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
  if (num_parts > 0) {
    const auto [groups, packed] = pack_groups(table);
    std::vector<Tile> tiles;
    for (size_t g = 0; g < groups.size(); ++g) {
      const std::int64_t items = a.groups[g].num_patches * groups[g].num_columns;
      for (std::int64_t item = 0; item < items; item += items_of_tile)
        tiles.push_back({uint(g), uint(item), uint(std::min(items_of_tile, items - item)), 0, 0});
    }
    const TransposeTable empty = {};
    patches = {image.add(std::span(&empty, 1)), std::int64_t(tiles.size())};
    image.set_address(patches.table, offsetof(TransposeTable, tiles), image.add<Tile>(tiles));
    image.set_address(patches.table, offsetof(TransposeTable, groups), image.add<Group>(groups));
    image.set_address(patches.table, offsetof(TransposeTable, weights), image.add<float>(packed));
    if (const std::int64_t places = pack_patch_points(a, image); places >= 0)
      image.set_address(patches.table, offsetof(TransposeTable, patch_points), places);
  }
  const std::int64_t before_rest = table.num_points() - num_rest;
  inputs = pack_gather(
      num_inputs, a.columns.span(), a.rest ? &*a.rest : nullptr,
      [&](std::int64_t row) { return row / num_rest * table.num_points() + before_rest + row % num_rest; }, image);
  if (a.first)
    first = pack_gather(
        table.num_control_points(), {}, &*a.first, [](std::int64_t row) { return row; }, image);
}

}  // namespace sublimit::gpu
