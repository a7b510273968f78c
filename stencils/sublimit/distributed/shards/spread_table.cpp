// SPDX-License-Identifier: Apache-2.0
#include "sublimit/distributed/shards/spread_table.h"

#include <algorithm>
#include <numeric>

namespace sublimit {
namespace {

std::vector<std::int64_t> all_inputs(const std::vector<LoadedShard>& shards) {
  std::vector<std::int64_t> inputs;
  for (const LoadedShard& shard : shards) inputs.insert(inputs.end(), shard.inputs.begin(), shard.inputs.end());
  return inputs;
}

/// The same table with patches that need none of the others' points first in every group.
/// @param num_inner  gets how many they are, group by group
PatternTable<double> inner_first(const PatternTable<double>& table, const std::function<bool(std::int32_t)>& is_own,
                                 std::vector<std::int64_t>& num_inner) {
  PatternTable<double>::Arrays arrays = table.arrays();
  num_inner.assign(arrays.groups.size(), 0);
  if (arrays.first) return table;  // its first step needs all points
  std::vector<std::int32_t> columns;
  std::vector<std::int64_t> first;
  columns.reserve(arrays.columns.size());
  for (size_t g = 0; g < arrays.groups.size(); ++g) {
    const auto& group = arrays.groups[g];
    const std::int64_t width = arrays.blocks[size_t(group.block)].columns, begin = table.starts()[g].columns;
    const auto of = [&](std::int64_t patch) {
      return std::span(arrays.columns).subspan(size_t(begin + patch * width), size_t(width));
    };
    for (const bool inner : {true, false})
      for (std::int64_t p = 0; p < group.num_patches; ++p) {
        if (std::ranges::all_of(of(p), is_own) != inner) continue;
        num_inner[g] += inner;
        columns.insert(columns.end(), of(p).begin(), of(p).end());
        first.push_back(table.first_point(g, table.starts()[g].patch + p));
      }
  }
  arrays.columns = std::move(columns), arrays.patch_points = std::move(first);
  return PatternTable<double>(table.num_control_points(), std::move(arrays));
}

const SpreadTable& of(Mat matrix) {
  void* table = nullptr;
  check_petsc(MatShellGetContext(matrix, &table));
  return *static_cast<const SpreadTable*>(table);
}

PetscErrorCode mult(Mat matrix, Vec x, Vec y) {
  return multiply(x, y, [&](auto from, auto to) { of(matrix).apply(from, 1, to); });
}

PetscErrorCode mult_transpose(Mat matrix, Vec x, Vec y) {
  return multiply(x, y, [&](auto from, auto to) { of(matrix).apply_transpose(from, 1, to); });
}

}  // namespace

SpreadTable::SpreadTable(const Ranks& ranks, std::vector<LoadedShard> shards, Runs runs)
    : shards_(std::move(shards)), runs_(std::move(runs)), halo_(ranks, runs_, all_inputs(shards_)) {
  num_inner_.resize(shards_.size());
  std::int64_t input = 0;
  for (size_t s = 0; s < shards_.size(); ++s) {
    first_input_.push_back(input);
    PatternTable<double>& table = shards_[s].table.table;
    table = inner_first(
        table, [&](std::int32_t column) { return halo_.is_own(input + column); }, num_inner_[s]);
    evaluators_.push_back(std::make_unique<PatternEvaluator<double>>(table));
    input += std::ssize(shards_[s].inputs);
    num_points_ += table.num_points();
    std::vector<std::int64_t>().swap(shards_[s].inputs);
  }
  first_input_.push_back(input);
}

void SpreadTable::apply_shard(size_t s, bool inner, std::span<const double> all, int channels,
                              std::span<double> points) const {
  const PatternEvaluator<double>& evaluator = *evaluators_[s];
  const PatternTable<double>& table = evaluator.table();
  if (inner && table.arrays().first) return;
  Evaluation<double> e;
  e.channels = channels;
  e.points =
      all.subspan(size_t(first_input_[s] * channels), size_t((first_input_[s + 1] - first_input_[s]) * channels));
  e.quantities[0] = points;
  if (table.arrays().first) {
    evaluator.apply(e);
    return;
  }
  for (size_t g = 0; g < num_inner_[s].size(); ++g) {
    const std::int64_t begin = table.starts()[g].patch, end = table.starts()[g + 1].patch,
                       middle = begin + num_inner_[s][g];
    if (inner ? middle > begin : end > middle)
      evaluator.apply_patches(e, {}, inner ? begin : middle, inner ? middle : end);
  }
  if (!inner) evaluator.apply_rest(e, {});
}

void SpreadTable::apply(std::span<const double> own, int channels, std::span<double> points) const {
  inputs_.resize(size_t(halo_.num_inputs() * channels));
  const std::span<double> inputs = inputs_;
  halo_.begin(own, channels, inputs);
  const auto pass = [&](bool inner) {
    std::int64_t next = 0;
    for (size_t s = 0; s < shards_.size(); ++s) {
      const std::int64_t count = shards_[s].table.table.num_points() * channels;
      apply_shard(s, inner, inputs, channels, points.subspan(size_t(next), size_t(count)));
      next += count;
    }
  };
  pass(true);
  halo_.end(own, channels, inputs);
  pass(false);
}

void SpreadTable::apply(std::span<const double> own, int channels,
                        const std::function<void(const LoadedShard&, std::span<const double>)>& made) const {
  inputs_.resize(size_t(halo_.num_inputs() * channels));
  const std::span<double> inputs = inputs_;
  std::vector<double> points;
  halo_.begin(own, channels, inputs);
  for (size_t s = 0; s < shards_.size(); ++s) {
    points.resize(size_t(shards_[s].table.table.num_points() * channels));
    apply_shard(s, true, inputs, channels, points);
    if (s == 0) halo_.end(own, channels, inputs);
    apply_shard(s, false, inputs, channels, points);
    made(shards_[s], points);
  }
  if (shards_.empty()) halo_.end(own, channels, inputs);
}

void SpreadTable::apply_transpose(std::span<const double> values, int channels, std::span<double> own) const {
  inputs_.resize(size_t(halo_.num_inputs() * channels));
  const std::span<double> inputs = inputs_;
  std::int64_t next = 0;
  for (size_t s = 0; s < shards_.size(); ++s) {
    const std::int64_t count = shards_[s].table.table.num_points() * channels;
    evaluators_[s]->apply_transpose(
        values.subspan(size_t(next), size_t(count)), channels,
        inputs.subspan(size_t(first_input_[s] * channels), size_t((first_input_[s + 1] - first_input_[s]) * channels)));
    next += count;
  }
  halo_.add(inputs, channels, own);
}

PetscObjectOf<Mat> matrix(const SpreadTable& table) {
  PetscObjectOf<Mat> matrix;
  check_petsc(MatCreateShell(PETSC_COMM_WORLD, table.num_points(), table.halo().num_own(), PETSC_DETERMINE,
                             PETSC_DETERMINE, const_cast<SpreadTable*>(&table), &matrix.value));
  check_petsc(MatShellSetOperation(matrix, MATOP_MULT, reinterpret_cast<void (*)()>(mult)));
  check_petsc(MatShellSetOperation(matrix, MATOP_MULT_TRANSPOSE, reinterpret_cast<void (*)()>(mult_transpose)));
  return matrix;
}

}  // namespace sublimit
