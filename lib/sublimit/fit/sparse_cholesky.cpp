// SPDX-License-Identifier: Apache-2.0
#include "sublimit/fit/sparse_cholesky.h"

#include <Eigen/OrderingMethods>
#include <Eigen/SparseCholesky>

#include <limits>
#include <vector>

#include "sublimit/base/error.h"
#include "sublimit/base/memory.h"

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

struct SparseCholesky::Factors {
  Permutation order;
  Eigen::SimplicialLLT<Columns, Eigen::Upper, Eigen::NaturalOrdering<Index>> llt;
  double entries = 0;
};

SparseCholesky::SparseCholesky(const SparseMatrix& M) : factors_(std::make_unique<Factors>()) {
  const Columns columns = M;
  Eigen::AMDOrdering<Index>()(columns.selfadjointView<Eigen::Upper>(), factors_->order);
  Columns ordered(M.rows(), M.cols());
  ordered.selfadjointView<Eigen::Upper>() =
      columns.selfadjointView<Eigen::Upper>().twistedBy(factors_->order.inverse());
  const std::int64_t entries = factor_entries(ordered);
  const std::string what = "a Cholesky factor of " + std::to_string(M.rows()) + " unknowns";
  if (entries > std::numeric_limits<Index>::max())
    throw ResourceError(what + " has more entries than 32-bit indices count; use the iterative method");
  check_memory(what, 12.0 * static_cast<double>(entries), "use the iterative method");
  factors_->entries = static_cast<double>(entries);
  factors_->llt.compute(ordered);
}
SparseCholesky::~SparseCholesky() = default;
SparseCholesky::SparseCholesky(SparseCholesky&&) noexcept = default;
SparseCholesky& SparseCholesky::operator=(SparseCholesky&&) noexcept = default;

bool SparseCholesky::positive() const { return factors_->llt.info() == Eigen::Success; }
double SparseCholesky::nonzeros() const { return factors_->entries; }

Points SparseCholesky::solve(const Points& right) const {
  const Permutation back = factors_->order.inverse();
  const Eigen::MatrixXd ordered = back * right;
  return factors_->order * factors_->llt.solve(ordered);
}

}  // namespace sublimit
