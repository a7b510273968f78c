// SPDX-License-Identifier: Apache-2.0
#include "sublimit/fit/detail/sparse_factors.h"

#include <Eigen/OrderingMethods>

#include <limits>
#include <vector>

#include "sublimit/base/detail/memory.h"
#include "sublimit/base/error.h"
#include "sublimit/core/detail/lu_memory.h"

namespace sublimit {
namespace {

using Columns = Eigen::SparseMatrix<double, Eigen::ColMajor, Index>;
using Permutation = Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, Index>;

/// Entries of the factor of M, the diagonal included: Eigen counts them with 32 bits, and takes the memory at once.
/// Row i has an entry in every column on the paths from its own columns towards i in the elimination tree.
/// Source: Liu 1990, "The role of elimination trees in sparse factorization".
std::int64_t factor_entries(const Columns& M) {
  const Index n = static_cast<Index>(M.cols());
  std::vector<Index> parent(n, -1), seen(n, -1);
  std::int64_t entries = n;
  for (Index i = 0; i < n; ++i) {
    seen[i] = i;
    for (Columns::InnerIterator e(M, i); e && e.row() < i; ++e)
      for (Index j = static_cast<Index>(e.row()); seen[j] != i; j = parent[j]) {
        if (parent[j] < 0) parent[j] = i;
        seen[j] = i;
        ++entries;
      }
  }
  return entries;
}

}  // namespace

struct SparseFactors::Factors {
  Permutation order;
  Eigen::SparseLU<Columns, Eigen::NaturalOrdering<Index>> lu;  // by supernodes: Eigen's Cholesky factors are not
  double entries = 0;
};

SparseFactors::SparseFactors(const SparseMatrix& M) : factors_(std::make_unique<Factors>()) {
  if (M.rows() == 0) throw InvalidParameter("a matrix without rows has no factors");  // Eigen would divide by its size
  Columns ordered = M;
  Eigen::AMDOrdering<Index>()(ordered, factors_->order);
  ordered = ordered.twistedBy(factors_->order.inverse());
  ordered.makeCompressed();
  const std::int64_t entries = factor_entries(ordered);
  const std::string what = "factors of " + std::to_string(M.rows()) + " unknowns";
  if (entries > std::numeric_limits<Index>::max())
    throw ResourceError(what + " have more entries than 32-bit indices count; use the iterative method");
  check_memory(what, 24.0 * static_cast<double>(entries), "use the iterative method");
  factors_->entries = static_cast<double>(entries);
  factors_->lu.isSymmetric(true);
  factors_->lu.setPivotThreshold(0);  // none is needed: positive definite
  factors_->lu.compute(ordered);
  check_memory_of(factors_->lu);
}
SparseFactors::~SparseFactors() = default;
SparseFactors::SparseFactors(SparseFactors&&) noexcept = default;
SparseFactors& SparseFactors::operator=(SparseFactors&&) noexcept = default;

bool SparseFactors::positive() const {
  return factors_->lu.info() == Eigen::Success && factors_->lu.signDeterminant() > 0;
}
double SparseFactors::nonzeros() const { return factors_->entries; }

Points SparseFactors::solve(const Points& right) const {
  if (factors_->lu.info() != Eigen::Success)
    throw AnalysisError("a matrix cannot be factored: " + factors_->lu.lastErrorMessage());
  const Permutation back = factors_->order.inverse();
  const Eigen::MatrixXd ordered = back * right;
  return factors_->order * factors_->lu.solve(ordered);
}

}  // namespace sublimit
