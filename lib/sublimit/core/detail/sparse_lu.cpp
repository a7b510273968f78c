// SPDX-License-Identifier: Apache-2.0
#include "sublimit/core/detail/sparse_lu.h"

#include "sublimit/core/detail/lu_memory.h"

namespace sublimit {

struct SparseLu::Factors {
  Eigen::SparseLU<ColumnMatrix> lu;
};

SparseLu::SparseLu(const ColumnMatrix& M) : factors_(std::make_unique<Factors>()) {
  factors_->lu.compute(M);
  check_memory_of(factors_->lu);
}
SparseLu::~SparseLu() = default;

bool SparseLu::has_factors() const { return factors_->lu.info() == Eigen::Success; }

Eigen::MatrixXd SparseLu::solve(const Eigen::MatrixXd& right) const { return factors_->lu.solve(right); }

}  // namespace sublimit
