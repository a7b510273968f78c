// SPDX-License-Identifier: Apache-2.0
#pragma once
// A table that no process has whole: ranks have shards of it, and runs of the control points.
#include <memory>

#include "sublimit/distributed/mesh/halo.h"
#include "sublimit/eval/pattern_evaluator.h"
#include "sublimit/stencils/shards/shard_file.h"

namespace sublimit {

/// Calls are of all ranks together, one after the other: they share memory for inputs.
class SpreadTable {
 public:
  /// @param shards  of this rank, any number
  /// @param runs    of the control points
  SpreadTable(const Ranks& ranks, std::vector<LoadedShard> shards, Runs runs);

  const Runs& control_points() const { return runs_; }
  /// Of this rank: shard after shard.
  std::int64_t num_points() const { return num_points_; }
  const std::vector<LoadedShard>& shards() const { return shards_; }
  const Halo& halo() const { return halo_; }

  /// Points of this rank's shards from control points of its run, interleaved; while those of others are on their way,
  /// patches that need none of them are made. All ranks call.
  void apply(std::span<const double> own, int channels, std::span<double> points) const;
  /// Applies one shard at a time, to bound memory; calls `made` after each finished shard.
  void apply(std::span<const double> own, int channels,
             const std::function<void(const LoadedShard&, std::span<const double>)>& made) const;
  /// own = transpose * values. Sums of ranks in any order.
  void apply_transpose(std::span<const double> values, int channels, std::span<double> own) const;

 private:
  void apply_shard(size_t shard, bool inner, std::span<const double> inputs, int channels,
                   std::span<double> points) const;
  std::vector<LoadedShard> shards_;
  Runs runs_;
  std::vector<std::int64_t> first_input_;  // of each shard, and the end
  std::int64_t num_points_ = 0;
  Halo halo_;
  std::vector<std::vector<std::int64_t>>
      num_inner_;  // of each shard: of each group, how many patches need no others' points
  std::vector<std::unique_ptr<PatternEvaluator<double>>> evaluators_;
  mutable std::vector<double> inputs_;
};

/// As PETSc's: MatMult is `apply` of one channel, MatMultTranspose its transpose; for any KSP.
/// @param table  must stay
PetscObjectOf<Mat> matrix(const SpreadTable& table);
PetscObjectOf<Mat> matrix(const SpreadTable&&) = delete;

}  // namespace sublimit
