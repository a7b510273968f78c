// SPDX-License-Identifier: Apache-2.0
#include "sublimit/neighborhood/piece_block.h"

#include <algorithm>

namespace sublimit {
namespace {

// Slots: a regular piece of catmull-clark has 16, of butterfly 48, of kobbelt 100.
constexpr Eigen::Index few = 32, large = 192;

}  // namespace

PieceBlock::PieceBlock(const SparseMatrix& B) : B_(B), origin_(Eigen::RowVectorXd(B.row(0)).tail(B.cols() - 1)) {
  for (Eigen::Index k = 0; k < B.nonZeros(); ++k) least_weight_ = std::min(least_weight_, B.valuePtr()[k]);
  if (std::max(B.rows(), B.cols()) > few) return;
  D_ = differences();
  SparseMatrix().swap(B_);
}

bool PieceBlock::is_large() const { return std::max(child_slots(), origin_.size() + 1) > large; }

RowMatrix PieceBlock::differences() const {
  if (is_dense()) return D_;
  return RowMatrix(B_).bottomRightCorner(B_.rows() - 1, B_.cols() - 1).rowwise() - origin_;
}

Points PieceBlock::apply(const Points& parent) const {
  if (is_dense()) return D_ * parent;
  const Points child = B_.rightCols(B_.cols() - 1) * parent;
  return child.bottomRows(child.rows() - 1).rowwise() - child.row(0);
}

RowMatrix PieceBlock::derivatives_pulled_back(const RowMatrix& rows) const {
  if (is_dense()) return rows * D_;
  RowMatrix result = -rows.rowwise().sum() * origin_;
  const Eigen::Index count = rows.rows(), from = rows.cols(), to = result.cols();
  for (Index i = 1; i < B_.rows(); ++i)
    for (SparseMatrix::InnerIterator it(B_, i); it; ++it) {
      if (it.col() == 0) continue;
      const double weight = it.value(), *row = rows.data() + i - 1;
      double* sum = result.data() + it.col() - 1;
      for (Eigen::Index k = 0; k < count; ++k, row += from, sum += to) *sum += *row * weight;
    }
  return result;
}

RowMatrix PieceBlock::pulled_back(const RowMatrix& rows) const {
  RowMatrix result = derivatives_pulled_back(rows);
  result.row(0) += origin_;
  return result;
}

PieceBlock PieceBlock::then(const PieceBlock& next) const {
  PieceBlock block;
  const RowMatrix D = differences();
  block.D_ = next.differences() * D;
  block.origin_ = origin_ + next.origin_ * D;
  return block;
}

}  // namespace sublimit
