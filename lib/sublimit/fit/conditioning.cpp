// SPDX-License-Identifier: Apache-2.0
#include "sublimit/fit/conditioning.h"

#include <algorithm>
#include <cmath>

#include "sublimit/base/error.h"
#include "sublimit/core/detail/dense_decompositions.h"
#include "sublimit/fit/detail/spectrum_ends.h"

namespace sublimit {
namespace {

// Of the smaller side, and entries in all: a second of work.
constexpr Index dense_side = 600;
constexpr double dense_entries = 4e6;

Conditioning sized(const SparseMatrix& rows) {
  Conditioning result;
  result.rows = Index(rows.rows());
  result.columns = Index(rows.cols());
  return result;
}

/// All of them, ascending, as the positive half of the eigenvalues +-s of (0 R; R^T 0), R the triangular factor (Golub,
/// Kahan 1965). Eigen 3.4's BDCSVD reads beyond its arrays at some matrices of low rank.
Eigen::VectorXd all_singular_values(const Eigen::MatrixXd& rows) {
  const Eigen::MatrixXd R = triangular_factor(rows.rows() < rows.cols() ? rows.transpose() : rows);
  const Eigen::Index n = R.cols();
  Eigen::MatrixXd both = Eigen::MatrixXd::Zero(2 * n, 2 * n);
  both.topRightCorner(n, n) = R;
  both.bottomLeftCorner(n, n) = R.transpose();
  return symmetric_eigenvalues(both).tail(n).cwiseMax(0);
}

/// Of what is perpendicular to the columns, at most so many directions.
Points complement(const Eigen::MatrixXd& columns, Index rank, Index most) {
  const Eigen::Index size = columns.rows(), count = std::min<Eigen::Index>(size - rank, most);
  return PivotedQr(columns).last_directions(count);
}

Conditioning dense_conditioning(const SparseMatrix& rows, double tolerance, Index most_directions) {
  Conditioning result = sized(rows);
  const Index least = std::min(result.rows, result.columns);
  const Eigen::MatrixXd dense(rows);
  result.singular_values = all_singular_values(dense);
  result.largest = result.singular_values[least - 1];
  for (const double s : result.singular_values) result.rank += s > tolerance * result.largest;
  if (result.rank > 0) result.smallest = result.singular_values[least - result.rank];
  result.free = complement(dense.transpose(), result.rank, most_directions);
  result.dependent = complement(dense, result.rank, most_directions);
  return result;
}

Conditioning sparse_conditioning(const SparseMatrix& rows, double tolerance, Index most_directions) {
  Conditioning result = sized(rows);
  const SparseMatrix across(rows.transpose());
  const bool wide = result.rows < result.columns;
  const SparseMatrix &tall = wide ? across : rows, &flat = wide ? rows : across;
  result.largest = largest_singular_value(tall, flat);
  const LeastSingular least = least_singular(tall, flat, tolerance * result.largest, most_directions);
  Index vanishing = 0;
  for (const double s : least.values) vanishing += s <= tolerance * result.largest;
  result.singular_values = least.values;
  result.rank = result.largest > 0 ? Index(flat.rows()) - vanishing : 0;
  if (result.rank > 0) result.smallest = vanishing < least.values.size() ? least.values[vanishing] : result.largest;
  result.free = Points(result.columns, 0);
  result.dependent = Points(result.rows, 0);
  (wide ? result.dependent : result.free) = least.vectors.leftCols(std::min(vanishing, most_directions));
  if (vanishing > 0 && result.rows == result.columns) {
    const LeastSingular other = least_singular(flat, tall, tolerance * result.largest, most_directions);
    result.dependent = other.vectors.leftCols(std::min({vanishing, most_directions, Index(other.vectors.cols())}));
  }
  return result;
}

}  // namespace

Conditioning conditioning(const SparseMatrix& rows, double tolerance, Index most_directions) {
  if (!(tolerance >= 0) || most_directions < 0)
    throw InvalidParameter("singular values need a tolerance and a number of directions that are not negative");
  for (Index r = 0; r < rows.rows(); ++r)
    for (SparseMatrix::InnerIterator e(rows, r); e; ++e)
      if (!std::isfinite(e.value()))
        throw InvalidParameter("row " + std::to_string(r) + " has a weight that is not finite");
  const Index least = Index(std::min(rows.rows(), rows.cols()));
  if (least == 0) {
    Conditioning none = sized(rows);
    none.free = Points::Identity(none.columns, std::min(none.columns, most_directions));
    none.dependent = Points::Identity(none.rows, std::min(none.rows, most_directions));
    return none;
  }
  const bool dense = least <= dense_side && double(rows.rows()) * double(rows.cols()) <= dense_entries;
  return dense ? dense_conditioning(rows, tolerance, most_directions)
               : sparse_conditioning(rows, tolerance, most_directions);
}

}  // namespace sublimit
