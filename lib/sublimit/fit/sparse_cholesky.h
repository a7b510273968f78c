// SPDX-License-Identifier: Apache-2.0
#pragma once
// Cholesky factors of a large sparse matrix, in a fill-reducing order, for all channels at once.
#include <memory>

#include "sublimit/types.h"

namespace sublimit {

/// M = L L^T of a symmetric, positive definite M, by Eigen.
class SparseCholesky {
 public:
  /// @param M  symmetric; both halves are stored, only the upper one is read
  /// @throws ResourceError  factors larger than memory, predicted before they are made
  explicit SparseCholesky(const SparseMatrix& M);
  ~SparseCholesky();
  SparseCholesky(SparseCholesky&&) noexcept;
  SparseCholesky& operator=(SparseCholesky&&) noexcept;

  /// All pivots were positive.
  bool positive() const;
  /// M^-1 * right, n x channels.
  Points solve(const Points& right) const;
  double nonzeros() const;  ///< of L

 private:
  struct Factors;
  std::unique_ptr<Factors> factors_;
};

}  // namespace sublimit
