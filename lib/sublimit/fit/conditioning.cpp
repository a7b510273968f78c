// SPDX-License-Identifier: Apache-2.0
#include "sublimit/fit/conditioning.h"

#include <Eigen/SVD>

#include <algorithm>

#include "sublimit/base/error.h"
#include "sublimit/base/memory.h"

namespace sublimit {

Conditioning conditioning(const SparseMatrix& rows, double tolerance, Index most_directions) {
  Conditioning result;
  result.rows = Index(rows.rows());
  result.columns = Index(rows.cols());
  result.free = Points(result.columns, 0);
  result.dependent = Points(result.rows, 0);
  const Index least = std::min(result.rows, result.columns);
  check_memory("singular values", 40.0 * double(least) * std::max(result.rows, result.columns), "use a smaller mesh");
  if (least == 0) {
    result.free = Points::Identity(result.columns, std::min(result.columns, most_directions));
    result.dependent = Points::Identity(result.rows, std::min(result.rows, most_directions));
    return result;
  }
  const Eigen::MatrixXd dense = rows;
  for (Eigen::Index i = 0; i < dense.size(); ++i)
    if (!std::isfinite(dense.data()[i])) throw InvalidParameter("a condition has a weight that is not finite");
  const Eigen::BDCSVD<Eigen::MatrixXd> svd(dense, Eigen::ComputeFullU | Eigen::ComputeFullV);
  result.singular_values = svd.singularValues().reverse();
  result.largest = result.singular_values[least - 1];
  for (const double s : result.singular_values) result.rank += s > tolerance * result.largest;
  if (result.rank > 0) result.smallest = result.singular_values[least - result.rank];
  result.free = svd.matrixV().rightCols(std::min(result.columns - result.rank, most_directions));
  result.dependent = svd.matrixU().rightCols(std::min(result.rows - result.rank, most_directions));
  return result;
}

}  // namespace sublimit
