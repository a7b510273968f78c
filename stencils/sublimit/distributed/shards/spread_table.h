// SPDX-License-Identifier: Apache-2.0
#pragma once
// A table that no process has whole: each rank has some of its shards, and a run of the control points.
#include <memory>

#include "sublimit/distributed/mesh/halo.h"
#include "sublimit/eval/evaluate/pattern_evaluator.h"
#include "sublimit/stencils/shards/shard_file.h"

namespace sublimit {

/// Applies the shards of all ranks. Functions that take points are collective: all ranks call them, one call at
/// a time, since calls share the memory for inputs.
class SpreadTable {
 public:
  /// @param shards  shards of this rank, any number
  /// @param runs    runs of the control points
  SpreadTable(const Ranks& ranks, std::vector<LoadedShard> shards, Runs runs);

  const Runs& control_points() const { return runs_; }
  /// Returns the number of points of this rank's shards.
  std::int64_t num_points() const { return num_points_; }
  const std::vector<LoadedShard>& shards() const { return shards_; }
  const Halo& halo() const { return halo_; }

  /// Sets the points of this rank's shards, shard after shard, from the control points of the ranks' runs, all
  /// interleaved. Patches that need no control points of other ranks are computed while these are being
  /// received.
  void apply(std::span<const double> own, int channels, std::span<double> points) const;
  /// Applies one shard at a time, to bound memory; calls `made` after each finished shard.
  void apply(std::span<const double> own, int channels,
             const std::function<void(const LoadedShard&, std::span<const double>)>& made) const;
  /// Sets `own` to the transpose times `values`. The order of sums over ranks is not fixed.
  void apply_transpose(std::span<const double> values, int channels, std::span<double> own) const;

 private:
  void apply_shard(size_t shard, bool inner, std::span<const double> inputs, int channels,
                   std::span<double> points) const;
  std::vector<LoadedShard> shards_;
  Runs runs_;
  std::vector<std::int64_t> first_input_;  // first input of each shard, and the end
  std::int64_t num_points_ = 0;
  Halo halo_;
  std::vector<std::vector<std::int64_t>>
      num_inner_;  // by shard and group: number of patches that need this rank's control points only
  std::vector<std::unique_ptr<PatternEvaluator<double>>> evaluators_;
  mutable std::vector<double> inputs_;
};

/// Returns the table as a shell matrix of PETSc, for any KSP: MatMult is `apply` with one channel,
/// MatMultTranspose is `apply_transpose`.
/// @param table  must outlive the result
PetscObjectOf<Mat> matrix(const SpreadTable& table);
PetscObjectOf<Mat> matrix(const SpreadTable&&) = delete;

}  // namespace sublimit
