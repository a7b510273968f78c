// SPDX-License-Identifier: Apache-2.0
#pragma once
// LU factors of square sparse matrices, compiled once: Eigen's templates take long to compile.
#include <memory>

#include <Eigen/SparseCore>

#include "sublimit/core/types.h"

namespace sublimit {

using ColumnMatrix = Eigen::SparseMatrix<double, Eigen::ColMajor, Index>;

/// Factors of a matrix in a fill-reducing order, with row pivoting (Eigen::SparseLU).
class SparseLu {
 public:
  explicit SparseLu(const ColumnMatrix& M);
  ~SparseLu();

  bool has_factors() const;  ///< true if no pivot was zero
  /// Returns M^-1 * right, n x columns.
  Eigen::MatrixXd solve(const Eigen::MatrixXd& right) const;

 private:
  struct Factors;
  std::unique_ptr<Factors> factors_;
};

}  // namespace sublimit
