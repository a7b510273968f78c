// SPDX-License-Identifier: Apache-2.0
#pragma once
// Stencils that no process has whole: each rank has some rows, over control points that ranks have in runs.
#include "sublimit/core/types.h"
#include "sublimit/distributed/mesh/halo.h"

namespace sublimit {

/// Through a halo, in any number of channels: inputs of this rank from control points of its run, and these as sums of
/// inputs. All ranks call.
using ConstPoints = Eigen::Ref<const Points>;
Points fetched(const Halo& halo, const ConstPoints& own);
Points summed(const Halo& halo, const ConstPoints& inputs);

class SpreadRows {
 public:
  /// @param rows   of this rank, over its inputs
  /// @param halo   of these inputs; must stay
  /// @param scale  by which each row is multiplied; empty: by 1
  /// @param channels  that `matrix` takes at once
  SpreadRows(SparseMatrix rows, const Halo& halo, Eigen::VectorXd scale = {}, int channels = 1);
  SpreadRows(SparseMatrix, const Halo&&, Eigen::VectorXd = {}, int = 1) = delete;

  std::int64_t num_rows() const { return rows_.rows(); }  ///< of this rank
  const Halo& halo() const { return halo_; }
  int channels() const { return channels_; }

  /// All ranks call. Scaled rows.
  /// @param own  control points of this rank's run, a column a channel
  Points apply(const ConstPoints& own) const;
  /// Control points of the own run: transpose * values. Sums of ranks in any order.
  Points apply_transpose(const ConstPoints& values) const;

 private:
  SparseMatrix rows_, transpose_;
  const Halo& halo_;
  Eigen::VectorXd scale_;
  int channels_;
};

/// As PETSc's, with MatMult and MatMultTranspose, of all channels at once: vectors are interleaved.
/// @param rows  must stay
PetscObjectOf<Mat> matrix(const SpreadRows& rows);
PetscObjectOf<Mat> matrix(const SpreadRows&&) = delete;

/// A sum of terms that ranks have, each over its inputs, as PETSc's assembled matrix over all control points. Those
/// that are in no term get a 1 on the diagonal.
/// @param own   of this rank: square, symmetric
/// @param runs  of the control points
PetscObjectOf<Mat> assembled(const Ranks& ranks, const SparseMatrix& own, const Runs& runs,
                             std::span<const std::int64_t> inputs, const Halo& halo);

}  // namespace sublimit
