// SPDX-License-Identifier: Apache-2.0
#pragma once
// Data of a fit problem that all solvers need: transposes, the matrix of the quadratic form, and sizes that
// residuals are relative to.
#include "sublimit/fit/fit_problem.h"

namespace sublimit {

/// Terms of a fit problem, which must outlive them.
struct FitTerms {
  explicit FitTerms(const FitProblem& problem);
  explicit FitTerms(const FitProblem&&) = delete;

  const FitProblem& problem;
  SparseMatrix At, Ct;                        ///< A^T W and C^T
  SparseMatrix Q;                             ///< A^T W A + H; 0 x 0 without an objective
  Eigen::VectorXd row_length;                 ///< length of each row of C; 1 for rows without entries
  double q_size = 0, a_size = 0, c_size = 0;  ///< largest sums of absolute values in a row of Q, A and C

  Index unknowns() const { return Index(problem.x0.rows()); }
  bool has_objective() const { return q_size > 0; }
  bool has_conditions() const { return problem.C.rows() > 0; }

  /// Returns A^T W (b - A x) - H x, half of the negative gradient.
  Points force(const Points& x) const;
  Points gap(const Points& x) const;  ///< d - C x
  /// Returns the residual of C x = d, relative to the size of the terms of C x and d.
  double relative_gap(const Points& gap, const Points& x) const;
};

/// Returns the largest entry of `gap`, relative to the size of the data plus that of rows of size `row_size`
/// times x.
double relative_to(const Points& gap, const Points& data, double row_size, const Points& x);
/// Returns the largest absolute value; 0 for an empty matrix.
double largest(const Points& points);
/// Returns the transpose.
SparseMatrix transposed(const SparseMatrix& matrix);

/// Solves by sparse factors.
FitSolution solve_directly(const FitTerms& terms, const FitSolverOptions& options);
/// True if conjugate gradients apply: no objective, or only conditions on single control points.
bool can_iterate(const FitTerms& terms);
/// Solves by conjugate gradients.
/// @param patience  if > 0, gives up if more iterations would be needed
FitSolution solve_iteratively(const FitTerms& terms, const FitSolverOptions& options, int patience = 0);

}  // namespace sublimit
