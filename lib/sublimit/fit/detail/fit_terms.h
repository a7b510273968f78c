// SPDX-License-Identifier: Apache-2.0
#pragma once
// What every method of fitting needs of its problem: transposes, the matrix of the quadratic form, sizes to measure
// residuals by.
#include "sublimit/fit/fit_problem.h"

namespace sublimit {

/// Terms of a fit problem, which must outlive them.
struct FitTerms {
  explicit FitTerms(const FitProblem& problem);
  explicit FitTerms(const FitProblem&&) = delete;

  const FitProblem& problem;
  SparseMatrix At, Ct;                        ///< A^T W and C^T
  SparseMatrix Q;                             ///< A^T W A + H; 0 x 0 where nothing is asked for
  Eigen::VectorXd row_length;                 ///< of the rows of C; 1 for rows without entries
  double q_size = 0, a_size = 0, c_size = 0;  ///< largest sums of absolute values in a row of Q, A and C

  Index unknowns() const { return Index(problem.x0.rows()); }
  bool has_objective() const { return q_size > 0; }
  bool has_conditions() const { return problem.C.rows() > 0; }

  /// A^T W (b - A x) - H x: half of the negative gradient.
  Points force(const Points& x) const;
  Points gap(const Points& x) const;  ///< d - C x
  /// Returns the residual of C x = d, relative to the size of the terms of C x and d.
  double relative_gap(const Points& gap, const Points& x) const;
};

/// The largest entry of `gap`, relative to the data and to what rows of that size make of x.
double relative_to(const Points& gap, const Points& data, double row_size, const Points& x);
/// Returns the largest absolute value; 0 for an empty matrix.
double largest(const Points& points);
SparseMatrix transposed(const SparseMatrix& matrix);

FitSolution solve_directly(const FitTerms& terms, const FitSolverOptions& options);
/// True if conjugate gradients apply: no objective, or no conditions but on single control points.
bool can_iterate(const FitTerms& terms);
/// @param patience  if > 0, gives up where more iterations would be needed
FitSolution solve_iteratively(const FitTerms& terms, const FitSolverOptions& options, int patience = 0);

}  // namespace sublimit
