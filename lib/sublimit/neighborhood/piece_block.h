// SPDX-License-Identifier: Apache-2.0
#pragma once
// Blocks of S between a piece of the limit and one of its children.
#include "sublimit/core/types.h"
#include "sublimit/neighborhood/piece_polynomial.h"

namespace sublimit {

/// From points of a piece to those of its child, in differences: over x_j - x_0 for the slots j > 0, so that weights of
/// positions sum to one and those of derivatives to zero whatever the rounding, which would grow like 2^k and 4^k with
/// the depth.
class PieceBlock {
 public:
  PieceBlock() = default;
  /// Returns the rows of S for the points of the child.
  explicit PieceBlock(const SparseMatrix& B);

  /// Returns the least entry of S, or 0 if all are positive.
  double least_weight() const { return least_weight_; }
  Eigen::Index child_slots() const { return is_dense() ? D_.rows() + 1 : B_.rows(); }
  /// Slot 0 of the child less that of the parent.
  const Eigen::RowVectorXd& origin() const { return origin_; }
  /// Differences of the child from those of the parent.
  RowMatrix differences() const;
  /// Applies the block to differences of points: x_j - x_0 of the parent become those of the child.
  Points apply(const Points& parent) const;

  /// Position row, and derivative rows below it, of the child as rows of the parent.
  RowMatrix pulled_back(const RowMatrix& rows) const;
  /// Derivative rows alone.
  RowMatrix derivatives_pulled_back(const RowMatrix& rows) const;
  /// First this, then `next`.
  PieceBlock then(const PieceBlock& next) const;

  /// Around vertices of high valence blocks are not multiplied with each other.
  bool is_large() const;
  /// Rows of S for the points of the child. Large blocks have them, those of few points do not.
  const SparseMatrix& rows() const { return B_; }

 private:
  bool is_dense() const { return B_.rows() == 0; }
  RowMatrix D_;     // of few points
  SparseMatrix B_;  // of more
  Eigen::RowVectorXd origin_;
  double least_weight_ = 0;
};

}  // namespace sublimit
