// SPDX-License-Identifier: Apache-2.0
#include "sublimit/pattern_evaluator.h"

#include "sublimit/base/parallel_for.h"
#include "sublimit/kernels/apply_patches.h"

namespace sublimit {

template <class Real>
PatternEvaluator<Real>::PatternEvaluator(const PatternTable<Real>& table, Options options)
    : table_(table), options_(options) {
  const auto& a = table.arrays();
  for (const auto& group : a.groups) {
    const auto& block = a.blocks[group.block];
    const std::int32_t stride =
        (group.num_rows + kernels::row_multiple - 1) / kernels::row_multiple * kernels::row_multiple;
    packed_.push_back({static_cast<std::int64_t>(weights_.size()), stride});
    for (int q = 0; q < a.quantities; ++q) {
      const auto begin = weights_.size();
      weights_.resize(begin + size_t(stride) * size_t(block.columns), Real(0));
      const Real* matrix = a.weights.data() + block.weights + q * std::int64_t{block.rows} * block.columns;
      for (std::int32_t k = 0; k < block.columns; ++k)
        for (std::int32_t i = 0; i < group.num_rows; ++i)
          weights_[begin + size_t(k) * size_t(stride) + size_t(i)] =
              matrix[std::int64_t{a.rows[group.rows + i]} * block.columns + k];
    }
  }
}

template <class Real>
void PatternEvaluator<Real>::apply(std::span<const Real> points, int channels, std::span<Real> result) const {
  table_.check(points, channels, result);
  const auto& a = table_.arrays();
  std::unique_ptr<Real[]> made;
  points = table_.inputs(points, channels, made);
  // Some tens of microseconds each.
  constexpr std::int64_t patches_per_block = 256;
  parallel_for_blocks(
      table_.num_patches(),
      [&](std::int64_t, std::int64_t begin, std::int64_t end) {
        table_.for_each_run(begin, end, [&](size_t g, std::int64_t first, std::int64_t count) {
          const auto& group = a.groups[g];
          const auto& block = a.blocks[group.block];
          const auto& start = table_.starts()[g];
          kernels::Patches<Real> patches;
          patches.stride = packed_[g].stride;
          patches.columns = block.columns;
          patches.rows = group.num_rows;
          patches.control_points = a.columns.data() + start.columns + (first - start.patch) * block.columns;
          patches.count = count;
          patches.points = points.data();
          patches.channels = channels;
          const bool placed = !a.patch_points.empty();
          patches.patch_points = placed ? a.patch_points.data() + first : nullptr;
          const std::int64_t point = placed ? 0 : table_.first_point(g, first);
          for (int q = 0; q < a.quantities; ++q) {
            patches.weights = weights_.data() + packed_[g].weights +
                              q * std::int64_t{packed_[g].stride} * std::int64_t{block.columns};
            patches.result = result.data() + (q * table_.num_points() + point) * channels;
            kernels::apply_patches(patches, !options_.reproducible);
          }
        });
      },
      patches_per_block);
  table_.apply_rest(points, channels, result);
}

template class PatternEvaluator<float>;
template class PatternEvaluator<double>;

}  // namespace sublimit
