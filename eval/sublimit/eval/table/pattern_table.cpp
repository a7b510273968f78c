// SPDX-License-Identifier: Apache-2.0
#include "sublimit/eval/table/pattern_table.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "sublimit/base/detail/interruption.h"
#include "sublimit/base/detail/parallel_for.h"
#include "sublimit/base/error.h"

namespace sublimit {
namespace {

[[noreturn]] void fail(const std::string& what) { throw InvalidParameter("pattern table: " + what); }

/// So that products with quantities are numbers too.
constexpr std::int64_t most_points = std::numeric_limits<std::int64_t>::max() / 8;

/// a * b, both not negative, or the largest number.
std::int64_t product(std::int64_t a, std::int64_t b) {
  constexpr std::int64_t largest = std::numeric_limits<std::int64_t>::max();
  return b != 0 && a > largest / b ? largest : a * b;
}

void check_range(const char* name, std::int64_t first, std::int64_t count, size_t size) {
  const auto limit = static_cast<std::int64_t>(size);
  if (first < 0 || count < 0 || first > limit || count > limit - first)
    fail(std::string(name) + " from " + std::to_string(first) + ", " + std::to_string(count) + " of them; there are " +
         std::to_string(limit));
}

void check_numbers(const char* name, std::span<const std::int32_t> numbers, std::int32_t limit) {
  for (const std::int32_t n : numbers)
    if (n < 0 || n >= limit)
      fail(std::string(name) + " " + std::to_string(n) + " does not exist; there are " + std::to_string(limit));
}

}  // namespace

template <class Real>
PatternTable<Real>::PatternTable(std::int32_t num_control_points, Arrays arrays)
    : num_control_points_(num_control_points), arrays_(std::move(arrays)) {
  const Arrays& a = arrays_;
  if (num_control_points < 0) fail(std::to_string(num_control_points) + " control points");
  if (a.quantities != 1 && a.quantities != 3 && a.quantities != 6)
    fail(std::to_string(a.quantities) + " quantities; 1, 3 and 6 are right");
  std::int32_t num_inputs = num_control_points;
  if (a.first) {
    if (a.first->num_control_points() != num_control_points)
      fail("its first step takes " + std::to_string(a.first->num_control_points()) + " points, not " +
           std::to_string(num_control_points));
    if (a.first->num_rows() > std::numeric_limits<std::int32_t>::max()) fail("its first step makes too many points");
    num_inputs = static_cast<std::int32_t>(a.first->num_rows());
  }
  for (const Block& block : a.blocks) {
    if (block.rows < 0 || block.columns < 0) fail("a block of negative size");
    check_range("weights", block.weights, product(a.quantities, std::int64_t{block.rows} * block.columns),
                a.weights.size());
  }
  for (const Real weight : a.weights)
    if (!std::isfinite(weight)) fail("a weight is not finite");
  check_numbers("control point", a.columns, num_inputs);
  Start at;
  for (const Group& group : a.groups) {
    starts_.push_back(at);
    if (group.block < 0 || group.block >= std::int64_t(a.blocks.size()))
      fail("block " + std::to_string(group.block) + " does not exist; there are " + std::to_string(a.blocks.size()));
    const Block& block = a.blocks[group.block];
    check_range("rows", group.rows, group.num_rows, a.rows.size());
    check_numbers("row", a.rows.span().subspan(group.rows, group.num_rows), block.rows);
    if (group.num_patches < 0) fail("a group of " + std::to_string(group.num_patches) + " patches");
    const std::int64_t columns = product(group.num_patches, block.columns),
                       points = product(group.num_patches, group.num_rows);
    check_range("columns", at.columns, columns, a.columns.size());
    if (points > most_points - at.point || group.num_patches > most_points - at.patch) fail("too many patches");
    at.patch += group.num_patches;
    at.columns += columns;
    at.point += points;
  }
  starts_.push_back(at);
  num_points_ = at.point;
  if (!a.patch_points.empty()) {
    if (std::int64_t(a.patch_points.size()) != at.patch)
      fail(std::to_string(a.patch_points.size()) + " places of points for " + std::to_string(at.patch) + " patches");
    for (size_t g = 0; g < a.groups.size(); ++g)
      for (std::int64_t patch = starts_[g].patch; patch < starts_[g + 1].patch; ++patch)
        if (a.patch_points[patch] < 0 || a.patch_points[patch] > num_points_ - a.groups[g].num_rows)
          fail("the points of patch " + std::to_string(patch) + " begin at " + std::to_string(a.patch_points[patch]) +
               " of " + std::to_string(num_points_));
  }
  if (a.rest) {
    if (a.rest->num_control_points() != num_inputs)
      fail("its rows take " + std::to_string(a.rest->num_control_points()) + " points, not " +
           std::to_string(num_inputs));
    if (a.rest->num_rows() % a.quantities != 0)
      fail(std::to_string(a.rest->num_rows()) + " rows of points in " + std::to_string(a.quantities) + " quantities");
    num_points_ += a.rest->num_rows() / a.quantities;
  }
  if (a.copies.size() % 2 != 0) fail("an odd number of points to copy to and from");
  for (const std::int32_t point : a.copies)
    if (point < 0 || point >= num_points_) fail("copies point " + std::to_string(point) + ", which does not exist");
  if (at.columns != std::int64_t(a.columns.size()))
    fail("patches have " + std::to_string(at.columns) + " columns; there are " + std::to_string(a.columns.size()));
}

template <class Real>
std::int64_t PatternTable<Real>::num_bytes() const {
  const Arrays& a = arrays_;
  return std::int64_t(a.blocks.size() * sizeof(Block) + a.groups.size() * sizeof(Group)) + a.weights.num_bytes() +
         a.rows.num_bytes() + a.columns.num_bytes() + a.patch_points.num_bytes() + a.copies.num_bytes() +
         (a.first ? a.first->num_bytes() : 0) + (a.rest ? a.rest->num_bytes() : 0);
}

template <class Real>
void PatternTable<Real>::check(std::span<const Real> points, int channels, std::span<const Real> result) const {
  const auto check_size = [&](const char* name, size_t size, std::int64_t rows) {
    if (channels < 1 || std::int64_t(size) != product(rows, channels))
      fail(std::string(name) + " holds " + std::to_string(size) + " numbers; " + std::to_string(rows) + " x " +
           std::to_string(channels) + " channels are needed");
  };
  check_size("points", points.size(), num_control_points_);
  check_size("result", result.size(), product(quantities(), num_points_));
}

template <class Real>
std::span<const Real> PatternTable<Real>::inputs(std::span<const Real> points, int channels,
                                                 std::unique_ptr<Real[]>& made) const {
  if (!arrays_.first) return points;
  const auto count = size_t(arrays_.first->num_rows()) * size_t(channels);
  made = std::make_unique_for_overwrite<Real[]>(count);
  arrays_.first->apply(points, channels, {made.get(), count});
  return {made.get(), count};
}

template <class Real>
void PatternTable<Real>::apply_rest(std::span<const Real> inputs, int channels, std::span<Real> result) const {
  if (arrays_.rest) {
    const StencilTable<Real>& rest = *arrays_.rest;
    const std::int64_t count = rest.num_rows() / quantities(), before = num_points_ - count;
    for (int q = 0; q < quantities(); ++q)
      parallel_for_blocks(count, [&](std::int64_t, std::int64_t begin, std::int64_t end) {
        rest.apply_rows(inputs.data(), channels, q * count + begin, q * count + end,
                        result.data() + (q * num_points_ + before + begin) * channels);
      });
  }
  const std::int32_t* pairs = arrays_.copies.data();
  parallel_for(static_cast<std::int64_t>(arrays_.copies.size() / 2), [&](std::int64_t i) {
    std::copy_n(result.data() + std::int64_t{pairs[2 * i + 1]} * channels, channels,
                result.data() + std::int64_t{pairs[2 * i]} * channels);
  });
}

template <class Real>
void PatternTable<Real>::apply(std::span<const Real> points, int channels, std::span<Real> result) const {
  check(points, channels, result);
  const Arrays& a = arrays_;
  std::unique_ptr<Real[]> made;
  points = inputs(points, channels, made);
  const auto apply_run = [&](size_t g, std::int64_t first, std::int64_t count, int q) {
    const Group& group = a.groups[g];
    const Block& block = a.blocks[group.block];
    const std::int64_t rank = first - starts_[g].patch;
    const std::int32_t* columns = a.columns.data() + starts_[g].columns + rank * block.columns;
    const Real* matrix = a.weights.data() + block.weights + q * std::int64_t{block.rows} * block.columns;
    for (; count > 0; --count, ++first, columns += block.columns) {
      Real* out = result.data() + (q * num_points_ + first_point(g, first)) * channels;
      for (std::int32_t i = 0; i < group.num_rows; ++i, out += channels) {
        const Real* weights = matrix + std::int64_t{a.rows[group.rows + i]} * block.columns;
        std::fill_n(out, channels, Real(0));
        for (std::int32_t k = 0; k < block.columns; ++k) {
          const Real* in = points.data() + std::int64_t{columns[k]} * channels;
          for (int c = 0; c < channels; ++c) out[c] += weights[k] * in[c];
        }
      }
    }
  };
  parallel_for_blocks(
      num_patches(),
      [&](std::int64_t, std::int64_t begin, std::int64_t end) {
        for_each_run(begin, end, [&](size_t g, std::int64_t first, std::int64_t count) {
          for (int q = 0; q < quantities(); ++q) apply_run(g, first, count, q);
        });
      },
      256);
  apply_rest(points, channels, result);
}

namespace {

/// Rows of a table that is being written down; each is a sum of others, and they come in any order.
template <class Real>
class RowWriter {
 public:
  RowWriter(std::int64_t num_rows) : rows_(size_t(num_rows)) {}
  void add(std::int32_t column, Real weight) { row_.push_back({column, weight}); }
  void end_row(std::int64_t number) {
    std::stable_sort(row_.begin(), row_.end(), [](const auto& x, const auto& y) { return x.first < y.first; });
    rows_[number].begin = static_cast<std::int64_t>(columns_.size());
    for (size_t k = 0; k < row_.size();) {
      const std::int32_t column = row_[k].first;
      Real sum = 0;
      for (; k < row_.size() && row_[k].first == column; ++k) sum += row_[k].second;
      if (sum == 0) continue;
      columns_.push_back(column);
      weights_.push_back(sum);
    }
    row_.clear();
    rows_[number].end = static_cast<std::int64_t>(columns_.size());
  }
  void copy_row(std::int64_t to, std::int64_t from) { rows_[to] = rows_[from]; }
  StencilTable<Real> table(std::int32_t num_control_points) const {
    std::vector<std::int64_t> offsets{0};
    std::vector<std::int32_t> columns;
    std::vector<Real> weights;
    columns.reserve(columns_.size());
    weights.reserve(columns_.size());
    for (const Row& row : rows_) {
      check_interruption();
      columns.insert(columns.end(), columns_.begin() + row.begin, columns_.begin() + row.end);
      weights.insert(weights.end(), weights_.begin() + row.begin, weights_.begin() + row.end);
      offsets.push_back(static_cast<std::int64_t>(columns.size()));
    }
    return StencilTable<Real>(num_control_points, std::move(offsets), std::move(columns), std::move(weights));
  }

 private:
  struct Row {
    std::int64_t begin = 0, end = 0;
  };
  std::vector<Row> rows_;
  std::vector<std::int32_t> columns_;
  std::vector<Real> weights_;
  std::vector<std::pair<std::int32_t, Real>> row_;
};

}  // namespace

template <class Real>
StencilTable<Real> PatternTable<Real>::expanded() const {
  const Arrays& a = arrays_;
  RowWriter<Real> rows(quantities() * num_points_);
  const auto add = [&](std::int32_t input, Real weight) {
    if (!a.first) return rows.add(input, weight);
    for (std::int64_t at = a.first->offsets()[input]; at < a.first->offsets()[input + 1]; ++at)
      rows.add(a.first->columns()[at], weight * a.first->weights()[at]);
  };
  for (int q = 0; q < quantities(); ++q) {
    for (size_t g = 0; g < a.groups.size(); ++g) {
      const Group& group = a.groups[g];
      const Block& block = a.blocks[group.block];
      const Real* matrix = a.weights.data() + block.weights + q * std::int64_t{block.rows} * block.columns;
      const std::int32_t* own = a.columns.data() + starts_[g].columns;
      for (std::int64_t patch = starts_[g].patch; patch < starts_[g + 1].patch; ++patch, own += block.columns) {
        check_interruption();
        for (std::int32_t i = 0; i < group.num_rows; ++i) {
          const Real* weights = matrix + std::int64_t{a.rows[group.rows + i]} * block.columns;
          for (std::int32_t k = 0; k < block.columns; ++k) add(own[k], weights[k]);
          rows.end_row(q * num_points_ + first_point(g, patch) + i);
        }
      }
    }
    if (!a.rest) continue;
    const std::int64_t count = a.rest->num_rows() / quantities();
    for (std::int64_t i = 0; i < count; ++i) {
      check_interruption();
      for (std::int64_t at = a.rest->offsets()[q * count + i]; at < a.rest->offsets()[q * count + i + 1]; ++at)
        add(a.rest->columns()[at], a.rest->weights()[at]);
      rows.end_row((q + 1) * num_points_ - count + i);
    }
  }
  for (size_t i = 0; i < a.copies.size(); i += 2) rows.copy_row(a.copies[i], a.copies[i + 1]);
  return rows.table(num_control_points_);
}

StencilTable<float> in_float(const StencilTable<double>& table) {
  return StencilTable<float>(table.num_control_points(), table.offsets(), table.columns(),
                             std::vector<float>(table.weights().begin(), table.weights().end()));
}

PatternTable<float> in_float(const PatternTable<double>& table) {
  const PatternTable<double>::Arrays& a = table.arrays();
  PatternTable<float>::Arrays b;
  b.quantities = a.quantities;
  for (const auto& block : a.blocks) b.blocks.push_back({block.rows, block.columns, block.weights});
  for (const auto& g : a.groups) b.groups.push_back({g.block, g.num_rows, g.rows, g.num_patches});
  b.weights = std::vector<float>(a.weights.begin(), a.weights.end());
  b.rows = a.rows;
  b.columns = a.columns;
  b.patch_points = a.patch_points;
  b.copies = a.copies;
  if (a.first) b.first = in_float(*a.first);
  if (a.rest) b.rest = in_float(*a.rest);
  return PatternTable<float>(table.num_control_points(), std::move(b));
}

template class PatternTable<float>;
template class PatternTable<double>;

}  // namespace sublimit
