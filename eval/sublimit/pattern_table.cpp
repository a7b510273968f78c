// SPDX-License-Identifier: Apache-2.0
#include "sublimit/pattern_table.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "sublimit/base/error.h"
#include "sublimit/base/parallel_for.h"

namespace sublimit {
namespace {

[[noreturn]] void fail(const std::string& what) { throw InvalidParameter("pattern table: " + what); }

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
    check_range("weights", block.weights, std::int64_t{block.rows} * block.columns, a.weights.size());
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
    check_numbers("row", std::span(a.rows).subspan(group.rows, group.num_rows), block.rows);
    const std::int64_t columns = product(group.num_patches, block.columns),
                       points = product(group.num_patches, group.num_rows);
    check_range("columns", at.columns, columns, a.columns.size());
    if (group.num_patches < 0 || points > std::numeric_limits<std::int64_t>::max() - at.point) fail("too many patches");
    at.patch += group.num_patches;
    at.columns += columns;
    at.point += points;
  }
  starts_.push_back(at);
  num_points_ = at.point;
  if (at.columns != std::int64_t(a.columns.size()))
    fail("patches have " + std::to_string(at.columns) + " columns; there are " + std::to_string(a.columns.size()));
}

template <class Real>
std::int64_t PatternTable<Real>::num_bytes() const {
  const auto bytes = [](const auto& list) { return std::int64_t(list.size()) * std::int64_t(sizeof(*list.data())); };
  const Arrays& a = arrays_;
  const std::int64_t own = bytes(a.blocks) + bytes(a.weights) + bytes(a.groups) + bytes(a.rows) + bytes(a.columns);
  return a.first ? own + bytes(a.first->offsets()) + bytes(a.first->columns()) + bytes(a.first->weights()) : own;
}

template <class Real>
void PatternTable<Real>::check(std::span<const Real> points, int channels, std::span<const Real> result) const {
  const auto check_size = [&](const char* name, size_t size, std::int64_t rows) {
    if (channels < 1 || std::int64_t(size) != product(rows, channels))
      fail(std::string(name) + " holds " + std::to_string(size) + " numbers; " + std::to_string(rows) + " x " +
           std::to_string(channels) + " channels are needed");
  };
  check_size("points", points.size(), num_control_points_);
  check_size("result", result.size(), num_points_);
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
void PatternTable<Real>::apply(std::span<const Real> points, int channels, std::span<Real> result) const {
  check(points, channels, result);
  const Arrays& a = arrays_;
  std::unique_ptr<Real[]> made;
  points = inputs(points, channels, made);
  const auto apply_run = [&](size_t g, std::int64_t first, std::int64_t count) {
    const Group& group = a.groups[g];
    const Block& block = a.blocks[group.block];
    const std::int64_t rank = first - starts_[g].patch;
    const std::int32_t* columns = a.columns.data() + starts_[g].columns + rank * block.columns;
    Real* out = result.data() + (starts_[g].point + rank * group.num_rows) * channels;
    for (; count > 0; --count, columns += block.columns)
      for (std::int32_t i = 0; i < group.num_rows; ++i, out += channels) {
        const Real* weights = a.weights.data() + block.weights + std::int64_t{a.rows[group.rows + i]} * block.columns;
        std::fill_n(out, channels, Real(0));
        for (std::int32_t k = 0; k < block.columns; ++k) {
          const Real* in = points.data() + std::int64_t{columns[k]} * channels;
          for (int c = 0; c < channels; ++c) out[c] += weights[k] * in[c];
        }
      }
  };
  parallel_for_blocks(
      num_patches(), [&](std::int64_t, std::int64_t begin, std::int64_t end) { for_each_run(begin, end, apply_run); },
      256);
}

template <class Real>
StencilTable<Real> PatternTable<Real>::expanded() const {
  const Arrays& a = arrays_;
  std::vector<std::int64_t> offsets{0};
  std::vector<std::int32_t> columns;
  std::vector<Real> weights;
  std::vector<std::pair<std::int32_t, Real>> row;
  for (size_t g = 0; g < a.groups.size(); ++g) {
    const Group& group = a.groups[g];
    const Block& block = a.blocks[group.block];
    for (std::int64_t rank = 0; rank < group.num_patches; ++rank) {
      const std::int32_t* own = a.columns.data() + starts_[g].columns + rank * block.columns;
      for (std::int32_t i = 0; i < group.num_rows; ++i) {
        const Real* w = a.weights.data() + block.weights + std::int64_t{a.rows[group.rows + i]} * block.columns;
        row.clear();
        for (std::int32_t k = 0; k < block.columns; ++k) {
          if (!a.first) {
            row.push_back({own[k], w[k]});
            continue;
          }
          for (std::int64_t at = a.first->offsets()[own[k]]; at < a.first->offsets()[own[k] + 1]; ++at)
            row.push_back({a.first->columns()[at], w[k] * a.first->weights()[at]});
        }
        std::stable_sort(row.begin(), row.end(), [](const auto& x, const auto& y) { return x.first < y.first; });
        for (size_t k = 0; k < row.size();) {
          const std::int32_t column = row[k].first;
          Real sum = 0;
          for (; k < row.size() && row[k].first == column; ++k) sum += row[k].second;
          if (sum == 0) continue;
          columns.push_back(column);
          weights.push_back(sum);
        }
        offsets.push_back(std::int64_t(columns.size()));
      }
    }
  }
  return StencilTable<Real>(num_control_points_, std::move(offsets), std::move(columns), std::move(weights));
}

PatternTable<float> in_float(const PatternTable<double>& table) {
  const PatternTable<double>::Arrays& a = table.arrays();
  PatternTable<float>::Arrays b;
  for (const auto& block : a.blocks) b.blocks.push_back({block.rows, block.columns, block.weights});
  for (const auto& g : a.groups) b.groups.push_back({g.block, g.num_rows, g.rows, g.num_patches});
  b.weights.assign(a.weights.begin(), a.weights.end());
  b.rows = a.rows;
  b.columns = a.columns;
  if (a.first)
    b.first.emplace(a.first->num_control_points(),
                    std::vector<std::int64_t>(a.first->offsets().begin(), a.first->offsets().end()),
                    std::vector<std::int32_t>(a.first->columns().begin(), a.first->columns().end()),
                    std::vector<float>(a.first->weights().begin(), a.first->weights().end()));
  return PatternTable<float>(table.num_control_points(), std::move(b));
}

template class PatternTable<float>;
template class PatternTable<double>;

}  // namespace sublimit
