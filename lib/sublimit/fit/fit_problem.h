// SPDX-License-Identifier: Apache-2.0
#pragma once
// The linear algebra of fitting: linear least squares with equality constraints and a quadratic energy.
//
//   FitProblem problem;
//   problem.A = place_rows(surface.map(), places), problem.b = values;
//   problem.H = fairness_energy(surface.map(), {.thin_plate = 1e-3});
//   problem.x0 = surface.points();
//   const FitSolution solution = solve(problem);
//
// Stencils are rows, so a surface through given data is the solution of
//
//   min  sum_i w_i |A_i x - b_i|^2 + x^T H x    subject to    C x = d,
//
// and of all such x the one nearest to a first guess x0. Where conditions depend on each other (the limits of a cube's
// eight corners) they are met if they agree; if they do not, |C x - d| is made least, and the sum among those x.
#include <Eigen/Core>

#include <functional>
#include <vector>

#include "sublimit/core/types.h"

namespace sublimit {

/// A problem to be solved. A matrix without rows means that its term is absent. All act on every column (channel) of x
/// alike.
struct FitProblem {
  SparseMatrix A;           ///< #soft x n: rows that are met as well as possible
  Points b;                 ///< #soft x channels
  Eigen::VectorXd weights;  ///< #soft, >= 0; empty: all 1
  SparseMatrix H;           ///< n x n, symmetric, positive semidefinite: fairness; 0 x 0 if absent
  SparseMatrix C;           ///< #hard x n: rows that are met exactly
  Points d;                 ///< #hard x channels
  Points x0;                ///< first guess, n x channels
};

/// How a problem is solved.
enum class FitMethod {
  /// Direct for up to ten thousand unknowns, with fairness, and if C relates several control points while something
  /// else is minimised. Otherwise iterative, and direct if that needs more than 250 steps (1000 with an objective).
  automatic,
  /// Sparse factorisation, refined by a proximal method. Directions in which A^T W A + H is below about 1e-8, relative
  /// to its size, count as free: x need not be the nearest one to the guess in them.
  direct,
  /// Conjugate gradients. If A^T W A + H is singular, "nearest" is then measured by the diagonal of that matrix. With
  /// an objective and conditions on more than single control points the direct method is used instead.
  iterative,
};

/// Options of `solve`.
struct FitSolverOptions {
  FitMethod method = FitMethod::automatic;
  double tolerance = 1e-14;   ///< largest residual of C x = d and of the gradient, relative to the data
  int max_iterations = 2000;  ///< of refinement or of conjugate gradients
  /// Called now and then, if given: iterations done and the relative residual.
  std::function<void(int, double)> progress = {};
};

/// Solution of a problem, and statistics of solving it.
struct [[nodiscard]] FitSolution {
  Points x;                              ///< n x channels
  FitMethod method = FitMethod::direct;  ///< method that was used
  int iterations = 0;                    ///< of refinement or of conjugate gradients, all channels at once
  std::vector<double> history = {};      ///< relative residual after each iteration
  bool converged = false;                ///< to the tolerance; false if conditions contradict each other
  double hard_residual = 0;              ///< largest |C x - d|
  double soft_residual = 0;              ///< root of the weighted mean of |A x - b|^2
};

/// Solves a problem. Deterministic: the same bits for any number of threads.
/// @throws InvalidParameter  shapes that do not fit, numbers that are not finite, negative weights
/// @throws ResourceError     factors larger than memory, predicted before they are made; `automatic` iterates instead,
///                           if it can
/// @throws AnalysisError     a factorisation that breaks down
FitSolution solve(const FitProblem& problem, const FitSolverOptions& options = {});

}  // namespace sublimit
