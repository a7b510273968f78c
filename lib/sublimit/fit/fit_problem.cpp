// SPDX-License-Identifier: Apache-2.0
#include "sublimit/fit/fit_problem.h"

#include <algorithm>
#include <cmath>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/error.h"
#include "sublimit/core/detail/sparse_product.h"
#include "sublimit/fit/detail/fit_terms.h"

namespace sublimit {
namespace {

std::string shape(Eigen::Index rows, Eigen::Index columns) {
  return std::to_string(rows) + " x " + std::to_string(columns);
}

void require(bool right, const std::string& message) {
  if (!right) throw InvalidParameter(message);
}

bool is_finite(const SparseMatrix& matrix) {
  for (Index r = 0; r < matrix.rows(); ++r)
    for (SparseMatrix::InnerIterator e(matrix, r); e; ++e)
      if (!std::isfinite(e.value())) return false;
  return true;
}

void check_rows(const char* matrix, const char* values, const SparseMatrix& rows, const Points& right,
                const Points& x0) {
  require(rows.rows() == 0 || rows.cols() == x0.rows(), std::string(matrix) + " is " + shape(rows.rows(), rows.cols()) +
                                                            ", but x0 has " + std::to_string(x0.rows()) +
                                                            " rows: as many columns are needed");
  require(rows.rows() == right.rows() && (rows.rows() == 0 || right.cols() == x0.cols()),
          std::string(values) + " is " + shape(right.rows(), right.cols()) + ", but " + matrix + " has " +
              std::to_string(rows.rows()) + " rows and x0 " + std::to_string(x0.cols()) + " columns");
  require(is_finite(rows), std::string(matrix) + " has an entry that is not finite");
  require(right.allFinite(), std::string(values) + " has an entry that is not finite");
}

void check(const FitProblem& problem) {
  require(problem.x0.allFinite(), "x0 has an entry that is not finite");
  check_rows("A", "b", problem.A, problem.b, problem.x0);
  check_rows("C", "d", problem.C, problem.d, problem.x0);
  require(problem.weights.size() == 0 || problem.weights.size() == problem.A.rows(),
          "there are " + std::to_string(problem.weights.size()) + " weights, but A has " +
              std::to_string(problem.A.rows()) + " rows");
  for (Eigen::Index i = 0; i < problem.weights.size(); ++i)
    require(problem.weights[i] >= 0 && std::isfinite(problem.weights[i]), "weight " + std::to_string(i) + " is " +
                                                                              format_number(problem.weights[i]) +
                                                                              "; weights are finite and not negative");
  if (problem.H.rows() == 0 && problem.H.cols() == 0) return;
  require(problem.H.rows() == problem.x0.rows() && problem.H.cols() == problem.x0.rows(),
          "H is " + shape(problem.H.rows(), problem.H.cols()) + ", but x0 has " + std::to_string(problem.x0.rows()) +
              " rows: it is square, of that size, or absent");
  require(is_finite(problem.H), "H has an entry that is not finite");
}

// Below this a factorisation takes no time that anybody would notice.
constexpr Index small_problem = 10000;
// Well-conditioned problems need fewer; factors of least squares, with 49 entries a row, cost more than many
// iterations.
constexpr int patience_with_rows = 250, patience_with_objective = 1000;

FitSolution solve_by(const FitTerms& terms, const FitSolverOptions& options) {
  if (options.method == FitMethod::direct || !can_iterate(terms)) return solve_directly(terms, options);
  if (options.method == FitMethod::iterative) return solve_iteratively(terms, options);
  const bool fairness = terms.problem.H.rows() > 0;  // the condition of thin plates grows like h^-4
  if (terms.unknowns() <= small_problem || fairness) return solve_directly(terms, options);
  FitSolverOptions short_run = options;
  const int patience = terms.has_objective() ? patience_with_objective : patience_with_rows;
  short_run.max_iterations = std::min(patience, options.max_iterations);
  FitSolution solution = solve_iteratively(terms, short_run, patience);
  if (solution.converged) return solution;
  try {
    return solve_directly(terms, options);
  } catch (const ResourceError&) {
    return solve_iteratively(terms, options);
  }
}

}  // namespace

FitSolution solve(const FitProblem& problem, const FitSolverOptions& options) {
  check(problem);
  const FitTerms terms(problem);
  FitSolution solution = solve_by(terms, options);
  if (problem.C.rows() > 0) solution.hard_residual = largest(terms.gap(solution.x));
  if (problem.A.rows() > 0) {
    const Points gap = apply(problem.A, solution.x) - problem.b;
    const Eigen::VectorXd squares = gap.rowwise().squaredNorm();
    const double sum = problem.weights.size() > 0 ? problem.weights.dot(squares) : squares.sum();
    const double weight = problem.weights.size() > 0 ? problem.weights.sum() : double(squares.size());
    if (weight > 0) solution.soft_residual = std::sqrt(sum / weight);
  }
  return solution;
}

}  // namespace sublimit
