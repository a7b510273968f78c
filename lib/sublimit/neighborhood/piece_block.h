// SPDX-License-Identifier: Apache-2.0
#pragma once
// Blocks of S between a piece of the limit and one of its children.
#include "sublimit/core/types.h"
#include "sublimit/neighborhood/piece_polynomial.h"

namespace sublimit {

/// Linear map from the points of a piece to those of its child, stored over differences x_j - x_0 for the slots
/// j > 0. Weights of positions then sum to one, and those of derivatives to zero, whatever the rounding;
/// otherwise rounding errors of derivatives would grow like 2^k and 4^k with the depth k.
class PieceBlock {
 public:
  PieceBlock() = default;
  /// @param B  rows of S for the points of the child, over the points of the piece
  explicit PieceBlock(const SparseMatrix& B);

  /// Returns the least entry of S, or 0 if all are positive.
  double least_weight() const { return least_weight_; }
  /// Returns the number of points of the child.
  Eigen::Index child_slots() const { return is_dense() ? D_.rows() + 1 : B_.rows(); }
  /// Returns slot 0 of the child minus slot 0 of the parent, as a row over differences of the parent.
  const Eigen::RowVectorXd& origin() const { return origin_; }
  /// Returns the matrix that takes differences of the parent to those of the child.
  RowMatrix differences() const;
  /// Applies the block to differences of points: x_j - x_0 of the parent become those of the child.
  Points apply(const Points& parent) const;

  /// Returns rows of the child (position, then derivatives) as rows of the parent, over differences.
  /// Derivatives stay by the parameters of the child.
  RowMatrix pulled_back(const RowMatrix& rows) const;
  /// Returns derivative rows of the child, without position, as rows of the parent.
  RowMatrix derivatives_pulled_back(const RowMatrix& rows) const;
  /// Returns the composition: first this block, then `next`.
  PieceBlock then(const PieceBlock& next) const;

  /// True for a block of many points, as around vertices of high valence: too large to multiply with others.
  bool is_large() const;
  /// Returns the rows of S for the points of the child; no rows if the block is small and stored as a dense
  /// matrix.
  const SparseMatrix& rows() const { return B_; }

 private:
  bool is_dense() const { return B_.rows() == 0; }
  RowMatrix D_;     // differences to differences, for few points
  SparseMatrix B_;  // rows of S, for more
  Eigen::RowVectorXd origin_;
  double least_weight_ = 0;
};

}  // namespace sublimit
