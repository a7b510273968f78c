// SPDX-License-Identifier: Apache-2.0
#pragma once
// Blocks of S between a piece of the limit and one of its children.
#include "sublimit/limit/piece_polynomial.h"
#include "sublimit/types.h"

namespace sublimit {

/// From points of a piece to those of its child, in differences: over x_j - x_0 for the slots j > 0, so that weights of
/// positions sum to one and those of derivatives to zero whatever the rounding, which would grow like 2^k and 4^k with
/// the depth.
class PieceBlock {
 public:
  PieceBlock() = default;
  /// Of the rows of S for the points of the child.
  explicit PieceBlock(const RowMatrix& B);
  static PieceBlock identity(Eigen::Index slots);

  Eigen::Index child_slots() const { return D_.rows() + B_.rows() + 1; }
  /// Slot 0 of the child less that of the parent.
  const Eigen::RowVectorXd& origin() const { return origin_; }
  /// Differences of the child from those of the parent.
  RowMatrix differences() const;

  /// Position row, and derivative rows below it, of the child as rows of the parent.
  RowMatrix pulled_back(const RowMatrix& rows) const;
  /// Derivative rows alone.
  RowMatrix derivatives_pulled_back(const RowMatrix& rows) const;
  /// First this, then `next`.
  PieceBlock then(const PieceBlock& next) const;

  /// Around vertices of high valence blocks are kept sparse, and are not multiplied with each other.
  bool is_large() const { return B_.rows() > 0; }

 private:
  RowMatrix D_;
  SparseMatrix B_;  // rows of S without those of slot 0: D = B - 1 origin
  Eigen::RowVectorXd origin_;
};

}  // namespace sublimit
