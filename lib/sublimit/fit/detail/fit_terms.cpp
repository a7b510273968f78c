// SPDX-License-Identifier: Apache-2.0
#include "sublimit/fit/detail/fit_terms.h"

#include <algorithm>
#include <cmath>

#include "sublimit/core/detail/sparse_product.h"

namespace sublimit {
namespace {

double row_norm(const SparseMatrix& matrix) {
  double most = 0;
  for (Index r = 0; r < matrix.rows(); ++r) {
    double sum = 0;
    for (SparseMatrix::InnerIterator e(matrix, r); e; ++e) sum += std::abs(e.value());
    most = std::max(most, sum);
  }
  return most;
}

}  // namespace

double largest(const Points& points) { return points.size() == 0 ? 0 : points.cwiseAbs().maxCoeff(); }

double relative_to(const Points& gap, const Points& data, double row_size, const Points& x) {
  const double size = std::max(largest(data), row_size * largest(x));
  return size > 0 ? largest(gap) / size : 0;
}

SparseMatrix transposed(const SparseMatrix& matrix) { return SparseMatrix(matrix.transpose()); }

FitTerms::FitTerms(const FitProblem& p) : problem(p), At(transposed(p.A)), Ct(transposed(p.C)) {
  if (p.weights.size() > 0)
    for (Index r = 0; r < At.rows(); ++r)
      for (SparseMatrix::InnerIterator e(At, r); e; ++e) e.valueRef() *= p.weights[e.col()];
  if (p.A.rows() > 0) Q = product(At, p.A);
  if (p.H.rows() > 0) Q = p.A.rows() > 0 ? SparseMatrix(Q + p.H) : p.H;
  q_size = row_norm(Q);
  a_size = row_norm(p.A);
  c_size = row_norm(p.C);
  row_length = Eigen::VectorXd::Ones(p.C.rows());
  for (Index r = 0; r < p.C.rows(); ++r)
    if (const double length = p.C.row(r).norm(); length > 0) row_length[r] = length;
}

Points FitTerms::force(const Points& x) const {
  Points result = Points::Zero(x.rows(), x.cols());
  if (problem.A.rows() > 0) result = apply(At, Points(problem.b - apply(problem.A, x)));
  if (problem.H.rows() > 0) result -= apply(problem.H, x);
  return result;
}

Points FitTerms::gap(const Points& x) const { return problem.d - apply(problem.C, x); }

double FitTerms::relative_gap(const Points& gap, const Points& x) const {
  return relative_to(gap, problem.d, c_size, x);
}

}  // namespace sublimit
