// SPDX-License-Identifier: Apache-2.0
#include "sublimit/eval/evaluate/detail/pattern_transpose.h"

#include <algorithm>
#include <vector>

#include "sublimit/base/detail/parallel_for.h"
#include "sublimit/eval/evaluate/detail/evaluation_layouts.h"
#include "sublimit/eval/evaluate/detail/occurrences.h"
#include "sublimit/eval/kernels/transpose_patches.h"

namespace sublimit {
namespace {

constexpr std::int64_t patches_per_block = 256;

/// Columns of a table by rows.
template <class Real>
struct Columns {
  std::vector<std::int64_t> offsets, rows;
  std::vector<Real> weights;
  Columns() = default;
  explicit Columns(const StencilTable<Real>& table) {
    Occurrences<std::int64_t> entries(table.num_control_points(), table.columns());
    std::vector<std::int64_t> row_of(table.columns().size());
    for (std::int64_t r = 0; r < table.num_rows(); ++r)
      std::fill(row_of.begin() + table.offsets()[r], row_of.begin() + table.offsets()[r + 1], r);
    rows.resize(row_of.size()), weights.resize(row_of.size());
    for (size_t i = 0; i < rows.size(); ++i) {
      rows[i] = row_of[entries.places[i]];
      weights[i] = table.weights()[entries.places[i]];
    }
    offsets = std::move(entries.offsets);
  }
};

}  // namespace

template <class Real>
struct PatternTranspose<Real>::Lists {
  Occurrences<std::int64_t> uses;  // of inputs by columns of patches
  Columns<Real> first, rest;
  explicit Lists(const PatternTable<Real>& t)
      : uses(t.arrays().first ? t.arrays().first->num_rows() : t.num_control_points(), t.arrays().columns) {
    if (t.arrays().first) first = Columns<Real>(*t.arrays().first);
    if (t.arrays().rest) rest = Columns<Real>(*t.arrays().rest);
  }
};

template <class Real>
PatternTranspose<Real>::PatternTranspose(const PatternTable<Real>& table)
    : table_(table), lists_(std::make_unique<ComputedOnce<Lists>>()) {}
template <class Real>
PatternTranspose<Real>::~PatternTranspose() = default;
template <class Real>
PatternTranspose<Real>::PatternTranspose(PatternTranspose&&) noexcept = default;

template <class Real>
void PatternTranspose<Real>::apply(std::span<const Real> values, int channels, std::span<Real> result, bool contract,
                                   BufferPool<Real>& buffers) const {
  const auto& a = table_.arrays();
  const auto quantities = size_t(checked_quantities<Real>(table_, values, channels, result));
  const size_t quantity = size_t(table_.num_points()) * size_t(channels);
  if (quantity == 0) return std::fill(result.begin(), result.end(), Real(0));
  const Lists& lists = lists_->get([&] { return Lists(table_); });

  // A copy gives what it gets to its source. Last ones first: sources may be copies too.
  const auto moved = buffers.take(a.copies.empty() ? 0 : quantity);
  const Real* positions = values.data();
  if (!a.copies.empty()) {
    std::copy_n(values.begin(), quantity, moved.span().begin());
    Real* const p = moved.span().data();
    for (std::int64_t i = std::int64_t(a.copies.size()) - 2; i >= 0; i -= 2) {
      Real* const to = p + std::int64_t{a.copies[i]} * channels;
      Real* const from = p + std::int64_t{a.copies[i + 1]} * channels;
      for (int c = 0; c < channels && to != from; ++c) from[c] += to[c], to[c] = 0;
    }
    positions = p;
  }
  const auto value = [&](size_t q) { return q == 0 ? positions : values.data() + q * quantity; };

  // What the columns of each patch get.
  const auto parts = buffers.take(a.columns.size() * size_t(channels));
  parallel_for_blocks(
      table_.num_patches(),
      [&](std::int64_t, std::int64_t begin, std::int64_t end) {
        table_.for_each_run(begin, end, [&](size_t g, std::int64_t first, std::int64_t count) {
          const auto& group = a.groups[g];
          const auto& block = a.blocks[group.block];
          const auto& start = table_.starts()[g];
          kernels::TransposedPatches<Real> p;
          p.quantities = static_cast<int>(quantities);
          for (size_t q = 0; q < quantities; ++q) {
            p.weights[q] = a.weights.data() + block.weights + std::int64_t(q) * block.rows * block.columns;
            p.values[q] = value(q);
          }
          p.columns = block.columns;
          p.rows = a.rows.span().subspan(group.rows, group.num_rows);
          p.count = count;
          if (a.patch_points.empty())
            p.first_point = table_.first_point(g, first);
          else
            p.patch_points = a.patch_points.data() + first;
          p.result = parts.span().data() + (start.columns + (first - start.patch) * block.columns) * channels;
          p.channels = channels;
          kernels::transpose_patches(p, contract);
        });
      },
      patches_per_block);

  // Sums over patches, and over points of no patch.
  const auto num_inputs = std::int64_t(lists.uses.offsets.size()) - 1;
  const auto between = buffers.take(a.first ? size_t(num_inputs) * size_t(channels) : 0);
  Real* const inputs = a.first ? between.span().data() : result.data();
  const std::int64_t num_rest = a.rest ? a.rest->num_rows() / a.quantities : 0,
                     before_rest = table_.num_points() - num_rest;
  parallel_for(num_inputs, [&](std::int64_t i) {
    Real* const out = inputs + i * channels;
    std::fill_n(out, channels, Real(0));
    for (std::int64_t k = lists.uses.offsets[i]; k < lists.uses.offsets[i + 1]; ++k) {
      const Real* const in = parts.span().data() + lists.uses.places[k] * channels;
      for (int c = 0; c < channels; ++c) out[c] += in[c];
    }
    if (num_rest == 0) return;
    for (std::int64_t k = lists.rest.offsets[i]; k < lists.rest.offsets[i + 1]; ++k) {
      const std::int64_t q = lists.rest.rows[k] / num_rest, point = before_rest + lists.rest.rows[k] % num_rest;
      if (size_t(q) >= quantities) break;  // rows ascend
      const Real* const in = value(size_t(q)) + point * channels;
      for (int c = 0; c < channels; ++c) out[c] += lists.rest.weights[k] * in[c];
    }
  });
  if (!a.first) return;
  parallel_for(table_.num_control_points(), [&](std::int64_t i) {
    Real* const out = result.data() + i * channels;
    std::fill_n(out, channels, Real(0));
    for (std::int64_t k = lists.first.offsets[i]; k < lists.first.offsets[i + 1]; ++k) {
      const Real* const in = inputs + lists.first.rows[k] * channels;
      for (int c = 0; c < channels; ++c) out[c] += lists.first.weights[k] * in[c];
    }
  });
}

template class PatternTranspose<float>;
template class PatternTranspose<double>;

}  // namespace sublimit
