// SPDX-License-Identifier: Apache-2.0
#pragma once
// Factors of a large, sparse, symmetric matrix in a fill-reducing order, for all channels at once.
#include <memory>

#include "sublimit/core/types.h"

namespace sublimit {

/// Factors of a positive definite matrix, by supernodes without pivoting (Eigen::SparseLU, many times faster here than
/// its Cholesky factors).
class SparseFactors {
 public:
  /// @param M  symmetric; both halves are stored
  /// @throws ResourceError  factors larger than memory, predicted before they are made
  explicit SparseFactors(const SparseMatrix& M);
  ~SparseFactors();
  SparseFactors(SparseFactors&&) noexcept;
  SparseFactors& operator=(SparseFactors&&) noexcept;

  /// True if no pivot was zero and an even number of them negative.
  bool positive() const;
  /// Returns M^-1 * right, n x channels.
  /// @throws AnalysisError  there are no factors: a pivot was zero, or memory ran out
  Points solve(const Points& right) const;
  double nonzeros() const;  ///< of one triangle, the diagonal included

 private:
  struct Factors;
  std::unique_ptr<Factors> factors_;
};

}  // namespace sublimit
