// SPDX-License-Identifier: Apache-2.0
#include "sublimit/eval/gpu/detail/packed_transpose.h"

#include <algorithm>
#include <map>
#include <vector>

#include "sublimit/eval/evaluate/detail/occurrences.h"

namespace sublimit::gpu {
namespace {

/// Columns of patches that a workgroup of a transpose takes.
constexpr std::int64_t items_at_once = 256;

/// What each of `count` inputs gets: parts that name it, and entries of rows.
/// @param value_of  the number of a row's value
template <class ValueOf>
Part pack_gather(std::int64_t count, std::span<const std::int32_t> parts, const StencilTable<float>* rows,
                 const ValueOf& value_of, Image& image) {
  const GatherTable empty = {};
  const Part part{image.add(std::span(&empty, 1)), count};
  if (!parts.empty()) {
    const Occurrences<std::uint32_t> uses(count, parts);
    image.set_address(part.table, offsetof(GatherTable, part_offsets), image.add<std::uint32_t>(uses.offsets));
    image.set_address(part.table, offsetof(GatherTable, parts), image.add<std::uint32_t>(uses.places));
  }
  if (rows && !rows->columns().empty()) {
    number(std::int64_t(rows->columns().size()), "entries of rows");
    const Occurrences<std::uint32_t> uses(count, rows->columns().span());
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
  std::map<std::vector<std::int32_t>, std::uint32_t> places;
  for (size_t g = 0; g < a.groups.size(); ++g) {
    const auto& group = a.groups[g];
    const auto& start = table.starts()[g];
    const std::int64_t columns = a.blocks[size_t(group.block)].columns;
    if (group.num_patches == 0) continue;
    const auto [packed, is_new] = places.try_emplace(rows_key(a, group), uint(weights.size()));
    groups.push_back({.weights = packed->second,
                      .stride = uint(group.num_rows),
                      .num_columns = uint(columns),
                      .columns = number(start.columns, "columns of patches"),
                      .num_rows = uint(group.num_rows),
                      .first_point = uint(start.point),
                      .first_patch = number(start.patch, "patches")});
    if (is_new) check_weights(std::ssize(weights), group.num_rows * columns, a.quantities);
    for (int q = 0; is_new && q < a.quantities; ++q)
      for (std::int64_t k = 0; k < columns; ++k)
        for (std::int64_t row = 0; row < group.num_rows; ++row) weights.push_back(row_of(a, group, row, q)[k]);
    for (std::int64_t first = 0; first < group.num_patches * columns; first += items_at_once)
      items.push_back({uint(groups.size() - 1), number(first, "columns of patches"),
                       uint(std::min(items_at_once, group.num_patches * columns - first))});
  }
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
