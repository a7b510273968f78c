// SPDX-License-Identifier: Apache-2.0
#pragma once
// A matrix of stencils that no process has whole: each rank has some of the rows. Control points are in the
// ranks' runs.
#include "sublimit/core/types.h"
#include "sublimit/distributed/mesh/halo.h"

namespace sublimit {

// Exchanges through a halo, with any number of columns. Collective: all ranks call. `fetched` returns the
// inputs of this rank from the control points of the ranks' runs; `summed` returns the sums of all ranks'
// inputs at the control points of this rank's run.
using ConstPoints = Eigen::Ref<const Points>;
Points fetched(const Halo& halo, const ConstPoints& own);
Points summed(const Halo& halo, const ConstPoints& inputs);

class SpreadRows {
 public:
  /// @param rows      rows of this rank over its inputs
  /// @param halo      halo of these inputs; must outlive this
  /// @param scale     factor of each row; empty: all are 1
  /// @param channels  number of channels that `matrix` multiplies at once
  SpreadRows(SparseMatrix rows, const Halo& halo, Eigen::VectorXd scale = {}, int channels = 1);
  SpreadRows(SparseMatrix, const Halo&&, Eigen::VectorXd = {}, int = 1) = delete;

  std::int64_t num_rows() const { return rows_.rows(); }  ///< rows of this rank
  const Halo& halo() const { return halo_; }
  int channels() const { return channels_; }

  /// Returns scale * rows * control points, for the rows of this rank. Collective: all ranks call.
  /// @param own  control points of this rank's run, one column for each channel
  Points apply(const ConstPoints& own) const;
  /// Returns the transpose times `values`, at the control points of this rank's run. The order of sums over
  /// ranks is not fixed. Collective: all ranks call.
  Points apply_transpose(const ConstPoints& values) const;

 private:
  SparseMatrix rows_, transpose_;
  const Halo& halo_;
  Eigen::VectorXd scale_;
  int channels_;
};

/// Returns the rows as a shell matrix of PETSc with MatMult and MatMultTranspose. Vectors interleave
/// `channels()` channels.
/// @param rows  must outlive the result
PetscObjectOf<Mat> matrix(const SpreadRows& rows);
PetscObjectOf<Mat> matrix(const SpreadRows&&) = delete;

/// Returns the sum of all ranks' matrices as an assembled matrix of PETSc over all control points. Control
/// points that are in none of them get a 1 on the diagonal. Collective: all ranks call.
/// @param own     matrix of this rank over its inputs: square, symmetric
/// @param runs    runs of the control points
/// @param inputs  control point of each row of `own`, as given to `halo`
PetscObjectOf<Mat> assembled(const Ranks& ranks, const SparseMatrix& own, const Runs& runs,
                             std::span<const std::int64_t> inputs, const Halo& halo);

}  // namespace sublimit
