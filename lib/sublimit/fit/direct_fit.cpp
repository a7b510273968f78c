// SPDX-License-Identifier: Apache-2.0
// Fitting by one factorisation. The proximal method of multipliers moves x and the multipliers l of C x = d by
//
//   [Q + rho, C^T; C, -delta] (dx, dl) = residual of [Q, C^T; C, 0] (x, l),
//
// which has a solution where the problem itself is singular, and whose limit is the solution nearest to where it began:
// no step has a part that neither Q nor C sees. dl is eliminated, so that M = Q + rho + C^T C / delta remains, which is
// positive definite. Where nothing but C x = d is asked for, x = x0 + C^T m and C C^T + delta remains instead.
// Sources: Rockafellar 1976, "Augmented Lagrangians and applications of the proximal point algorithm in convex
// programming"; Golub, Greif 2003, "On solving block-structured indefinite linear systems" (why C^T C helps).
#include <cmath>
#include <limits>

#include "sublimit/core/detail/sparse_product.h"
#include "sublimit/fit/detail/conjugate_residuals.h"
#include "sublimit/fit/detail/fit_terms.h"
#include "sublimit/fit/detail/sparse_factors.h"

namespace sublimit {
namespace {

// Of rows of C at unit length. Below it, products of C swallow the digits of Q: eps / delta must stay far below rho.
constexpr double delta = 1e-5;
// Of Q at unit size: what regular problems can bear, and what singular ones need; smaller where no C takes digits.
constexpr double rho_regular = 1e-9, rho_singular = 1e-6;
constexpr double rho_regular_alone = 1e-12, rho_singular_alone = 1e-8;
// Of C C^T alone, where nothing else has digits to lose.
constexpr double delta_alone = 1e-9;

SparseMatrix diagonal(Index n, double value) {
  SparseMatrix D(n, n);
  D.setIdentity();
  return D * value;
}

SparseMatrix scaled_rows(const SparseMatrix& C, const Eigen::VectorXd& length) {
  SparseMatrix result = C;
  for (Index r = 0; r < C.rows(); ++r)
    for (SparseMatrix::InnerIterator e(result, r); e; ++e) e.valueRef() /= length[r];
  return result;
}

struct Residual {
  Points values;
  double gradient = 0, rows = 0;  ///< relative; of the rows C x = d
  double least_squares = 0;       ///< and of C^T (C x - d) = 0, which contradicting rows still can meet
  double relative() const { return std::max(gradient, rows); }
};

/// One way of writing the problem as a linear system of unknowns z.
class System {
 public:
  virtual ~System() = default;
  virtual Points start() const = 0;
  virtual Points points(const Points& z) const = 0;
  virtual Residual residual(const Points& z) const = 0;
  virtual Points step(const Points& residual) const = 0;  ///< of z, that about brings the residual to zero
  virtual Points effect(const Points& step) const = 0;    ///< what a step takes from the residual
};

/// Only C x = d, at most as many rows as unknowns: z = x, all of whose steps lie in the range of C^T. (Adding to m
/// instead would round where m is large.)
class LeastChange : public System {
 public:
  explicit LeastChange(const FitTerms& terms)
      : t_(terms),
        C_(scaled_rows(terms.problem.C, terms.row_length)),
        Ct_(transposed(C_)),
        factors_(SparseMatrix(product(C_, Ct_) + diagonal(Index(C_.rows()), delta_alone))) {}
  Points start() const override { return t_.problem.x0; }
  Points points(const Points& z) const override { return z; }
  Residual residual(const Points& x) const override {
    const Points gap = t_.gap(x);
    Residual r{.values = t_.row_length.cwiseInverse().asDiagonal() * gap, .rows = t_.relative_gap(gap, x)};
    r.least_squares = largest(apply(Ct_, r.values)) / std::max({largest(x), largest(r.values), 1e-300});
    return r;
  }
  Points step(const Points& residual) const override { return apply(Ct_, factors_.solve(residual)); }
  Points effect(const Points& step) const override { return apply(C_, step); }

 private:
  const FitTerms& t_;
  SparseMatrix C_, Ct_;
  SparseFactors factors_;
};

/// Anything: z = (x, l).
class Saddle : public System {
 public:
  /// @param rows_count  A x = b is to be met, if it can be
  explicit Saddle(const FitTerms& terms, bool rows_count = false)
      : t_(terms),
        rows_count_(rows_count),
        C_(terms.has_conditions() ? scaled_rows(terms.problem.C, terms.row_length) : SparseMatrix(0, n())),
        Ct_(transposed(C_)),
        Q_(terms.Q / terms.q_size),
        rho_(C_.rows() > 0 ? rho_regular : rho_regular_alone),
        factors_(matrix(rho_)) {
    // Inverse iteration: regular problems have no eigenvalue near to rho.
    singular_ = !factors_.positive() || least_eigenvalue() < 100 * rho_;
    if (!singular_) return;
    rho_ = C_.rows() > 0 ? rho_singular : rho_singular_alone;
    factors_ = SparseFactors(matrix(rho_));
  }

  bool singular() const { return singular_; }
  /// From now on steps have no part that neither Q nor C sees, not even by rounding.
  void keep_to_seen() { seen_only_ = true; }

  /// The part of y that neither Q nor C sees. Refined, since the factors know eigenvectors to eps / (delta lambda)
  /// only.
  Points unseen(Points y) const {
    for (int i = 0; i < 3; ++i) {
      y *= rho_;
      Points z = factors_.solve(y);
      for (int k = 0; k < 2; ++k) z += factors_.solve(Points(y - product_with_matrix(z)));
      y = z;
    }
    return y;
  }

  Points start() const override {
    Points z = Points::Zero(n() + C_.rows(), t_.problem.x0.cols());
    z.topRows(n()) = t_.problem.x0;
    return z;
  }
  Points points(const Points& z) const override { return z.topRows(n()); }
  Residual residual(const Points& z) const override {
    const Points x = points(z), force = t_.force(x), hold = apply(Ct_, Points(z.bottomRows(C_.rows())));
    Residual r{.values = Points::Zero(z.rows(), z.cols())};
    r.values.topRows(n()) = force / t_.q_size - hold;
    const double size = largest(force) / t_.q_size + largest(x) + largest(hold);
    if (size > 0) r.gradient = largest(r.values.topRows(n())) / size;
    if (rows_count_) {
      r.least_squares = r.gradient;
      r.rows = relative_to(t_.problem.b - apply(t_.problem.A, x), t_.problem.b, t_.a_size, x);
    }
    if (C_.rows() == 0) return r;
    const Points gap = t_.gap(x);
    r.rows = t_.relative_gap(gap, x);
    r.values.bottomRows(C_.rows()) = t_.row_length.cwiseInverse().asDiagonal() * gap;
    r.least_squares =
        largest(apply(Ct_, Points(r.values.bottomRows(C_.rows())))) / std::max({largest(x), largest(gap), 1e-300});
    return r;
  }
  Points step(const Points& residual) const override {
    Points right = residual.topRows(n());
    if (seen_only_) right -= unseen(right);
    if (C_.rows() > 0) right += apply(Ct_, Points(residual.bottomRows(C_.rows()))) / delta;
    Points result(residual.rows(), residual.cols());
    result.topRows(n()) = factors_.solve(right);
    if (C_.rows() > 0)
      result.bottomRows(C_.rows()) = (apply(C_, Points(result.topRows(n()))) - residual.bottomRows(C_.rows())) / delta;
    return result;
  }
  Points effect(const Points& step) const override {
    const Points dx = step.topRows(n());
    Points result(step.rows(), step.cols());
    result.topRows(n()) = apply(Q_, dx);
    if (C_.rows() == 0) return result;
    result.topRows(n()) += apply(Ct_, Points(step.bottomRows(C_.rows())));
    result.bottomRows(C_.rows()) = apply(C_, dx);
    return result;
  }

 private:
  Index n() const { return t_.unknowns(); }
  SparseMatrix matrix(double rho) const {
    SparseMatrix M = Q_ + diagonal(n(), rho);
    if (C_.rows() > 0) M = SparseMatrix(M + SparseMatrix(product(Ct_, C_) / delta));
    return M;
  }
  Points product_with_matrix(const Points& y) const {
    Points result = apply(Q_, y) + rho_ * y;
    if (C_.rows() > 0) result += apply(Ct_, apply(C_, y)) / delta;
    return result;
  }
  double least_eigenvalue() const {
    Points v(n(), 1);
    std::uint32_t state = 1;
    for (Index i = 0; i < n(); ++i) v(i, 0) = double((state = state * 1664525u + 1013904223u) >> 8) / (1 << 24) - 0.5;
    double length = 1;
    for (int i = 0; i < 5; ++i) {
      v /= v.norm();
      v = factors_.solve(v);
      length = v.norm();
    }
    return 1 / length;
  }

  const FitTerms& t_;
  bool rows_count_;
  SparseMatrix C_, Ct_, Q_;
  double rho_;
  SparseFactors factors_;
  bool singular_ = false, seen_only_ = false;
};

/// Steps until nothing is gained any more.
/// @param z  where to begin; the best that was found
void refine(const System& system, const FitSolverOptions& options, Points& z, FitSolution& solution) {
  ConjugateResiduals residuals;
  double least = std::numeric_limits<double>::infinity(), least_normal = least;
  Points best = z;
  solution.converged = false;
  for (int iteration = 0, without_gain = 0;; ++iteration) {
    const Residual r = system.residual(z);
    const double relative = r.relative(), normal = std::max(r.gradient, r.least_squares);
    if (!std::isfinite(relative)) break;
    if (iteration > 0) {
      solution.history.push_back(relative);
      solution.iterations = int(solution.history.size());
      if (options.progress) options.progress(solution.iterations, relative);
    }
    without_gain = relative < 0.7 * least || normal < 0.7 * least_normal ? 0 : without_gain + 1;
    // Rows that contradict each other keep their distance; then what least squares asks for decides.
    if (relative <= options.tolerance ? relative < least : !solution.converged && normal < least_normal) {
      best = z;
      solution.converged = relative <= options.tolerance;
    }
    least = std::min(least, relative);
    least_normal = std::min(least_normal, normal);
    if (relative <= 0.1 * options.tolerance || without_gain == (solution.converged ? 2 : 8) ||
        solution.iterations >= options.max_iterations)
      break;
    Points step = system.step(r.values), effect = system.effect(step);
    z += step * residuals.add(r.values, step, effect).asDiagonal();
  }
  z = best;
}

void solve_system(const FitTerms& terms, const FitSolverOptions& options, FitSolution& solution,
                  bool rows_count = false) {
  if (!terms.has_objective()) {
    const LeastChange system(terms);
    Points z = system.start();
    refine(system, options, z, solution);
    solution.x = system.points(z);
    return;
  }
  Saddle system(terms, rows_count);
  Points z = system.start();
  refine(system, options, z, solution);
  if (system.singular()) {
    const Index n = terms.unknowns();
    // Twice, since the factors know the unseen part to five digits only.
    for (int i = 0; i < 2; ++i) z.topRows(n) -= system.unseen(Points(z.topRows(n) - terms.problem.x0));
    system.keep_to_seen();
    refine(system, options, z, solution);
  }
  solution.x = system.points(z);
}

/// min |C x - d|
FitProblem least_squares(const FitProblem& p) {
  FitProblem result;
  result.A = p.C;
  result.b = p.d;
  result.C = SparseMatrix(0, p.C.cols());
  result.d = Points(0, p.d.cols());
  result.x0 = p.x0;
  return result;
}

}  // namespace

FitSolution solve_directly(const FitTerms& terms, const FitSolverOptions& options) {
  const FitProblem& p = terms.problem;
  FitSolution solution{.x = p.x0, .method = FitMethod::direct};
  if (p.x0.size() == 0 || (!terms.has_objective() && terms.c_size == 0)) {
    solution.converged = p.C.rows() == 0 || largest(p.d) == 0;
    return solution;
  }
  const bool tall = !terms.has_objective() && p.C.rows() > p.C.cols();
  if (!tall) {
    solve_system(terms, options, solution);
    if (solution.converged || !terms.has_conditions()) return solution;
  }
  // Conditions that contradict each other, or too many of them: what least squares makes of them can be met.
  FitProblem nearest = least_squares(p);
  solution.x = p.x0;
  if (terms.c_size > 0) solve_system(FitTerms(nearest), options, solution, true);
  if (terms.has_objective()) {
    nearest = p;
    nearest.d = apply(p.C, solution.x);
    solve_system(FitTerms(nearest), options, solution);
  }
  solution.converged = terms.relative_gap(terms.gap(solution.x), solution.x) <= options.tolerance;
  return solution;
}

}  // namespace sublimit
