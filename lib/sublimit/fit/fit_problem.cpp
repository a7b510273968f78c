// SPDX-License-Identifier: Apache-2.0
#include "sublimit/fit/fit_problem.h"

#include <Eigen/SparseCholesky>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "sublimit/base/error.h"
#include "sublimit/sparse_product.h"

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
                                                                              std::to_string(problem.weights[i]) +
                                                                              "; weights are finite and not negative");
  if (problem.H.rows() == 0 && problem.H.cols() == 0) return;
  require(problem.H.rows() == problem.x0.rows() && problem.H.cols() == problem.x0.rows(),
          "H is " + shape(problem.H.rows(), problem.H.cols()) + ", but x0 has " + std::to_string(problem.x0.rows()) +
              " rows: it is square, of that size, or absent");
  require(is_finite(problem.H), "H has an entry that is not finite");
}

double largest(const Points& points) { return points.size() == 0 ? 0 : points.cwiseAbs().maxCoeff(); }

/// Largest sum of absolute values of a row.
double row_norm(const SparseMatrix& matrix) {
  double most = 0;
  for (Index r = 0; r < matrix.rows(); ++r) {
    double sum = 0;
    for (SparseMatrix::InnerIterator e(matrix, r); e; ++e) sum += std::abs(e.value());
    most = std::max(most, sum);
  }
  return most;
}

SparseMatrix transposed(const SparseMatrix& matrix) { return SparseMatrix(matrix.transpose()); }

/// The problem as the saddle point of x and of the multipliers of C, by the proximal method of multipliers: every step
/// solves
///   [Q + rho, C^T; C, -delta] (dx, dl) = residual,  Q = A^T W A + H,
/// which is quasi-definite, so it can be factorised in any order without pivots.
class Saddle {
 public:
  explicit Saddle(const FitProblem& problem)
      : p_(problem), n_(Index(problem.x0.rows())), At_(transposed(problem.A)), Ct_(transposed(problem.C)) {
    if (p_.weights.size() > 0)
      for (Index r = 0; r < At_.rows(); ++r)
        for (SparseMatrix::InnerIterator e(At_, r); e; ++e) e.valueRef() *= p_.weights[e.col()];
    SparseMatrix Q(n_, n_);
    if (p_.A.rows() > 0) Q = product(At_, p_.A);
    if (p_.H.rows() > 0) Q = p_.A.rows() > 0 ? SparseMatrix(Q + p_.H) : p_.H;
    double diagonal = 0;
    for (Index r = 0; r < n_ && Q.nonZeros() > 0; ++r) diagonal = std::max(diagonal, std::abs(Q.coeff(r, r)));
    const bool least_change = diagonal == 0;
    if (diagonal > 0) q_ = diagonal;
    double longest = 0;
    for (Index r = 0; r < p_.C.rows(); ++r) longest = std::max(longest, p_.C.row(r).norm());
    if (longest > 0) c_ = longest;
    q_norm_ = row_norm(Q);
    rho_ = least_change ? 1 : 1e-9;
    const double delta = 1e-9;
    std::vector<Eigen::Triplet<double>> lower;
    for (Index r = 0; r < n_; ++r) {
      lower.emplace_back(r, r, rho_);
      for (SparseMatrix::InnerIterator e(Q, r); e && e.col() <= r; ++e) lower.emplace_back(r, e.col(), e.value() / q_);
    }
    for (Index r = 0; r < p_.C.rows(); ++r) {
      lower.emplace_back(n_ + r, n_ + r, -delta);
      for (SparseMatrix::InnerIterator e(p_.C, r); e; ++e) lower.emplace_back(n_ + r, e.col(), e.value() / c_);
    }
    Eigen::SparseMatrix<double> K(n_ + p_.C.rows(), n_ + p_.C.rows());
    K.setFromTriplets(lower.begin(), lower.end());
    ldlt_.compute(K);
  }

  FitSolution solve(const FitSolverOptions& options) {
    FitSolution best;
    best.x = p_.x0;
    Points x = p_.x0, multipliers = Points::Zero(p_.C.rows(), p_.x0.cols());
    refine(options, x, multipliers, best, false);
    if (q_norm_ > 0) {  // without Q all steps lie in the range of C^T
      x = best.x - unseen(best.x - p_.x0);
      multipliers = best_multipliers_;
      refine(options, x, multipliers, best, true);
    }
    return best;
  }

 private:
  struct Residual {
    Points of_x, of_rows;
    double gradient = 0, rows = 0, least_squares = 0;  ///< relative; of C x = d, and of the rows' normal equations
  };

  void refine(const FitSolverOptions& options, Points& x, Points& multipliers, FitSolution& best, bool again) {
    double least = std::numeric_limits<double>::infinity(), least_normal = least;
    for (int iteration = 0, without_gain = 0; without_gain < 8; ++iteration) {
      const Residual r = residual(x, multipliers);
      const double relative = std::max(r.gradient, r.rows), normal = std::max(r.gradient, r.least_squares);
      if (!std::isfinite(relative)) break;
      if (iteration > 0 || again) {
        best.history.push_back(relative);
        best.iterations = int(best.history.size());
        if (options.progress) options.progress(best.iterations, relative);
      }
      without_gain = relative < 0.7 * least || normal < 0.7 * least_normal ? 0 : without_gain + 1;
      // Rows that contradict each other keep their distance; then what least squares asks for decides.
      if (relative <= options.tolerance ? relative < least : normal < least_normal) {
        best.x = x;
        best_multipliers_ = multipliers;
        best.converged = relative <= options.tolerance;
      }
      least = std::min(least, relative);
      least_normal = std::min(least_normal, normal);
      if (relative <= 0.1 * options.tolerance || best.iterations >= options.max_iterations) break;
      Eigen::MatrixXd right = Eigen::MatrixXd::Zero(n_ + p_.C.rows(), x.cols());
      if (q_norm_ > 0) right.topRows(n_) = r.of_x;
      if (p_.C.rows() > 0) right.bottomRows(p_.C.rows()) = r.of_rows;
      if (again) right.topRows(n_) -= unseen(r.of_x);
      const Points step = ldlt_.solve(right);
      multipliers += step.bottomRows(p_.C.rows());
      if (q_norm_ > 0)
        x += step.topRows(n_);
      else
        x = p_.x0 - apply(Ct_, multipliers) / c_;
    }
  }

  /// The part of y that neither Q nor C sees: rounding puts it there, amplified by 1 / rho.
  Points unseen(const Points& y) const {
    Eigen::MatrixXd part = Eigen::MatrixXd::Zero(n_ + p_.C.rows(), y.cols());
    part.topRows(n_) = y;
    for (int i = 0; i < 2; ++i) {
      part.topRows(n_) *= rho_;
      part.bottomRows(p_.C.rows()).setZero();
      part = ldlt_.solve(part).eval();
    }
    return part.topRows(n_);
  }

  Residual residual(const Points& x, const Points& multipliers) const {
    Residual r;
    r.of_x = Points::Zero(n_, x.cols());
    double scale = q_norm_ * largest(x);
    if (p_.A.rows() > 0) {
      r.of_x = apply(At_, Points(p_.b - apply(p_.A, x)));
      scale += largest(r.of_x);
    }
    if (p_.H.rows() > 0) r.of_x -= apply(p_.H, x);
    r.of_x /= q_;
    scale /= q_;
    if (p_.C.rows() > 0) {
      r.of_rows = p_.d - apply(p_.C, x);
      const double size = std::max(largest(p_.d), largest(x) * c_);
      if (size > 0) r.rows = largest(r.of_rows) / size;
      if (size > 0) r.least_squares = largest(apply(Ct_, r.of_rows)) / (size * c_);
      r.of_rows /= c_;
      if (q_norm_ > 0) {
        const Points force = apply(Ct_, multipliers) / c_;
        r.of_x -= force;
        scale += largest(force);
      }
    }
    if (q_norm_ > 0 && scale > 0) r.gradient = largest(r.of_x) / scale;
    return r;
  }

  const FitProblem& p_;
  Index n_;
  SparseMatrix At_, Ct_;  // At_ weighted
  double q_ = 1, c_ = 1, q_norm_ = 0, rho_ = 1;
  Points best_multipliers_;
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>, Eigen::Lower> ldlt_;
};

}  // namespace

FitSolution solve(const FitProblem& problem, const FitSolverOptions& options) {
  check(problem);
  FitSolution solution = Saddle(problem).solve(options);
  solution.method = FitMethod::direct;
  if (problem.C.rows() > 0) solution.hard_residual = largest(Points(apply(problem.C, solution.x) - problem.d));
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
