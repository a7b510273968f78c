// SPDX-License-Identifier: Apache-2.0
#pragma once
// Matrices of balls (Arb), with operations at the thread's precision (PrecisionScope).
#include <arb_mat.h>

#include <optional>

#include "sublimit/certificates/numbers/ball.h"

namespace sublimit {

/// A matrix of balls.
class BallMatrix {
 public:
  BallMatrix(Eigen::Index rows, Eigen::Index columns) { arb_mat_init(m_, rows, columns); }
  /// Converts a matrix of numbers that have an `enclosure()`, or that convert to a ball.
  template <class Matrix>
  explicit BallMatrix(const Eigen::MatrixBase<Matrix>& entries) : BallMatrix(entries.rows(), entries.cols()) {
    for (Eigen::Index i = 0; i < rows(); ++i)
      for (Eigen::Index j = 0; j < columns(); ++j)
        if constexpr (requires { entries(i, j).enclosure(); })
          arb_set(entry(i, j), entries(i, j).enclosure().get());
        else
          arb_set(entry(i, j), Ball(entries(i, j)).get());
  }
  BallMatrix(const BallMatrix& other) : BallMatrix(other.rows(), other.columns()) { arb_mat_set(m_, other.m_); }
  BallMatrix(BallMatrix&& other) noexcept : BallMatrix(0, 0) { arb_mat_swap(m_, other.m_); }
  BallMatrix& operator=(BallMatrix other) noexcept {
    arb_mat_swap(m_, other.m_);
    return *this;
  }
  ~BallMatrix() { arb_mat_clear(m_); }

  Eigen::Index rows() const { return arb_mat_nrows(m_); }
  Eigen::Index columns() const { return arb_mat_ncols(m_); }
  arb_ptr entry(Eigen::Index i, Eigen::Index j) { return arb_mat_entry(m_, i, j); }
  arb_srcptr entry(Eigen::Index i, Eigen::Index j) const { return arb_mat_entry(m_, i, j); }
  Ball operator()(Eigen::Index i, Eigen::Index j) const { return Ball(entry(i, j)); }
  const arb_mat_struct* get() const { return m_; }
  arb_mat_struct* get() { return m_; }

  /// Returns the midpoints rounded to doubles: for searches, not for proofs.
  Eigen::MatrixXd middle() const;
  BallMatrix transposed() const;
  /// Returns an enclosure of the inverses; nothing unless the matrix is certainly regular.
  std::optional<BallMatrix> inverse() const;
  Ball trace() const;
  friend BallMatrix operator*(const BallMatrix& a, const BallMatrix& b);

 private:
  arb_mat_t m_;
};

/// Returns an enclosure of the largest row sum of moduli; the whole line if an entry is not finite.
Ball maximum_norm(const BallMatrix& A);

}  // namespace sublimit
