// SPDX-License-Identifier: Apache-2.0
#include "sublimit/limit/piece_block.h"

#include <algorithm>

namespace sublimit {
namespace {

constexpr Eigen::Index large = 192;  // slots: a regular piece of kobbelt has 100

}  // namespace

PieceBlock::PieceBlock(const RowMatrix& B) : origin_(B.row(0).tail(B.cols() - 1)) {
  if (std::max(B.rows(), B.cols()) > large) {
    B_ = B.bottomRightCorner(B.rows() - 1, B.cols() - 1).sparseView(0, 0);
  } else {
    D_ = B.bottomRightCorner(B.rows() - 1, B.cols() - 1).rowwise() - origin_;
  }
}

PieceBlock PieceBlock::identity(Eigen::Index slots) {
  PieceBlock block;
  block.D_ = RowMatrix::Identity(slots - 1, slots - 1);
  block.origin_ = Eigen::RowVectorXd::Zero(slots - 1);
  return block;
}

RowMatrix PieceBlock::differences() const {
  if (!is_large()) return D_;
  RowMatrix D = RowMatrix(B_);
  return D.rowwise() - origin_;
}

RowMatrix PieceBlock::derivatives_pulled_back(const RowMatrix& rows) const {
  if (!is_large()) return rows * D_;
  RowMatrix result = -rows.rowwise().sum() * origin_;
  for (Eigen::Index i = 0; i < B_.rows(); ++i)
    for (SparseMatrix::InnerIterator it(B_, i); it; ++it) result.col(it.col()) += rows.col(i) * it.value();
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
