// SPDX-License-Identifier: Apache-2.0
#pragma once
// Factors of a large, sparse, symmetric matrix in a fill-reducing order, for all channels at once.
#include <memory>

#include "sublimit/core/types.h"

namespace sublimit {

/// Supernodal factors of a positive definite matrix, without pivoting (Eigen::SparseLU, here many times faster
/// than Eigen's Cholesky factors).
class SparseFactors {
 public:
  /// @param M  symmetric; both halves are stored
  /// @throws ResourceError  factors larger than memory, predicted before they are computed
  explicit SparseFactors(const SparseMatrix& M);
  ~SparseFactors();
  SparseFactors(SparseFactors&&) noexcept;
  SparseFactors& operator=(SparseFactors&&) noexcept;

  /// True if no pivot was zero, and the number of negative ones is even.
  bool positive() const;
  /// Returns M^-1 * right, n x channels.
  /// @throws AnalysisError  there are no factors: a pivot was zero, or memory ran out
  Points solve(const Points& right) const;
  double nonzeros() const;  ///< nonzeros of one triangle, including the diagonal

 private:
  struct Factors;
  std::unique_ptr<Factors> factors_;
};

}  // namespace sublimit
