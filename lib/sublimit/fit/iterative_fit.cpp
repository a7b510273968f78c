// SPDX-License-Identifier: Apache-2.0
// Fitting by conjugate gradients. Conditions alone: least squares of d - C x0 - C y, without a preconditioner, since
// the steps then lie in the range of C^T and end at the x nearest to x0. An objective: Q y = force, preconditioned by
// the diagonal of Q; conditions on single control points are met first and keep them out of the iteration.
#include <algorithm>
#include <cmath>
#include <limits>

#include "sublimit/core/detail/sparse_product.h"
#include "sublimit/fit/detail/conjugate_gradients.h"
#include "sublimit/fit/detail/fit_terms.h"

namespace sublimit {
namespace {

/// Begins again with the true residual as often as that gains something.
class Restarts {
 public:
  Restarts(const FitSolverOptions& options, FitSolution& solution, int patience)
      : options_(options), solution_(solution), patience_(patience) {}

  /// @param now   relative residual of x
  /// @param rest  the largest entry of what conjugate gradients bring to zero
  /// @param goal  for it
  /// @return  whether to go on from x
  bool worth(double now, double rest, double goal, const Points& x) {
    const bool gained = rest < 0.3 * least_;
    if (rest < least_) {
      solution_.x = x;
      least_ = rest;
      solution_.converged = now <= options_.tolerance;
    }
    goal_ = goal;
    return gained && now > 0.5 * options_.tolerance && solution_.iterations < options_.max_iterations;
  }

  bool go_on(double residual, double relative) {
    solution_.history.push_back(relative);
    solution_.iterations = int(solution_.history.size());
    if (options_.progress && solution_.iterations % 10 == 0) options_.progress(solution_.iterations, relative);
    if (patience_ > 0 && solution_.iterations % 50 == 0) {
      // By now as large a share of the decades should be done as of the iterations.
      const double first = solution_.history.front(), done = std::log(relative / first);
      if (done > std::log(options_.tolerance / first) * solution_.iterations / patience_) return false;
    }
    return residual > goal_ && std::isfinite(residual) && solution_.iterations < options_.max_iterations;
  }

 private:
  const FitSolverOptions& options_;
  FitSolution& solution_;
  int patience_;
  double least_ = std::numeric_limits<double>::infinity(), goal_ = 0;
};

void meet_conditions(const FitTerms& terms, const FitSolverOptions& options, FitSolution& solution, int patience) {
  const FitProblem& p = terms.problem;
  Restarts restarts(options, solution, patience);
  Points x = p.x0;
  while (true) {
    Points gap = terms.gap(x);
    const Points normal = apply(terms.Ct, gap);
    const double size = std::max({largest(p.d), terms.c_size * largest(x), 1e-300}), goal = 0.2 * options.tolerance;
    if (!restarts.worth(largest(gap) / size, largest(normal), 0, x)) break;
    // Conditions that contradict each other keep a gap, of which C^T leaves nothing.
    x += least_squares_gradients(p.C, terms.Ct, gap, [&](int, double rest, double seen) {
      return restarts.go_on(1, rest / size) && rest > goal * size && seen > 0.01 * goal * size * terms.c_size;
    });
  }
}

/// Rows of C with one entry each, and each on an unknown of its own.
bool only_pins(const SparseMatrix& C) {
  std::vector<bool> pinned(C.cols(), false);
  for (Index r = 0; r < C.rows(); ++r) {
    Index entries = 0;
    for (SparseMatrix::InnerIterator e(C, r); e; ++e) {
      if (e.value() == 0) continue;
      if (++entries > 1 || pinned[e.col()]) return false;
      pinned[e.col()] = true;
    }
    if (entries == 0) return false;
  }
  return true;
}

void minimise(const FitTerms& terms, const FitSolverOptions& options, FitSolution& solution, int patience) {
  const FitProblem& p = terms.problem;
  Eigen::VectorXd diagonal = terms.Q.diagonal();
  Points x = p.x0;
  for (Index r = 0; r < p.C.rows(); ++r)
    for (SparseMatrix::InnerIterator e(p.C, r); e; ++e) {
      if (e.value() == 0) continue;
      x.row(e.col()) = p.d.row(r) / e.value();
      diagonal[e.col()] = 0;
    }
  const Eigen::VectorXd free = diagonal.unaryExpr([](double d) { return d > 0 ? 1.0 : 0.0; });
  // Pinned directions are zero, and what Q makes of the others there has no part in any product.
  const auto S = [&](const Points& y) { return apply(terms.Q, y); };
  Restarts restarts(options, solution, patience);
  while (true) {
    Points residual = terms.force(x);
    const double scale = std::max(largest(residual) + terms.q_size * largest(x), 1e-300);
    residual = free.asDiagonal() * residual;
    const double relative = largest(residual) / scale;
    if (!restarts.worth(relative, relative * scale, 0.1 * options.tolerance * scale, x)) break;
    x += conjugate_gradients(S, diagonal, residual, [&](int, double now) { return restarts.go_on(now, now / scale); });
  }
}

}  // namespace

bool can_iterate(const FitTerms& terms) { return !terms.has_objective() || only_pins(terms.problem.C); }

FitSolution solve_iteratively(const FitTerms& terms, const FitSolverOptions& options, int patience) {
  FitSolution solution;
  solution.x = terms.problem.x0;
  solution.method = FitMethod::iterative;
  if (terms.has_objective())
    minimise(terms, options, solution, patience);
  else
    meet_conditions(terms, options, solution, patience);
  return solution;
}

}  // namespace sublimit
