// SPDX-License-Identifier: Apache-2.0
#include "sublimit/fit/sparse_cholesky.h"

#include <Eigen/SparseCholesky>

namespace sublimit {

struct SparseCholesky::Factors {
  Eigen::SimplicialLLT<Eigen::SparseMatrix<double>, Eigen::Lower> llt;
};

SparseCholesky::SparseCholesky(const SparseMatrix& M) : factors_(std::make_unique<Factors>()) {
  factors_->llt.compute(M);
}
SparseCholesky::~SparseCholesky() = default;
SparseCholesky::SparseCholesky(SparseCholesky&&) noexcept = default;
SparseCholesky& SparseCholesky::operator=(SparseCholesky&&) noexcept = default;
bool SparseCholesky::positive() const { return factors_->llt.info() == Eigen::Success; }
Points SparseCholesky::solve(const Points& right) const { return factors_->llt.solve(Eigen::MatrixXd(right)); }
double SparseCholesky::nonzeros() const { return double(factors_->llt.matrixL().nestedExpression().nonZeros()); }

}  // namespace sublimit
