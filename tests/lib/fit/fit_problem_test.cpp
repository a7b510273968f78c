// SPDX-License-Identifier: Apache-2.0
#include "sublimit/fit/fit_problem.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <Eigen/Dense>
#include <limits>
#include <random>

#include "meshes/meshes.h"
#include "sublimit/base/error.h"
#include "sublimit/core/detail/dense_decompositions.h"
#include "support/tolerance.h"
#include "truth/limit_system.h"

namespace sublimit {
namespace {

using Eigen::MatrixXd;
using testing::limit_system;

// Squared singular values of random small matrices: some thousands between the largest and the least.
constexpr double random_problem = 1e-9;

SparseMatrix sparse(const MatrixXd& dense) { return SparseMatrix(dense.sparseView()); }

double difference(const MatrixXd& a, const MatrixXd& b) { return (a - b).cwiseAbs().maxCoeff(); }

/// Small whole numbers and zeros: what depends on each other does so exactly, and singular values keep off zero.
class RandomProblems {
 public:
  MatrixXd matrix(Index rows, Index columns, Index rank) {
    MatrixXd result(rows, columns);
    for (double& x : result.reshaped()) x = generator_() % 2 ? 0 : double(generator_() % 5) - 2;
    for (Index r = rank; r < rows; ++r)
      result.row(r) = rank == 0 ? result.row(r) * 0 : (result.row(generator_() % rank) - result.row(r % rank)).eval();
    return result;
  }
  FitProblem next() {
    const Index n = number(6, 20), soft = number(0, n), hard = number(0, n + 3), channels = number(1, 3);
    const bool objective = generator_() % 4 != 0;
    FitProblem p;
    p.x0 = matrix(n, channels, n);
    p.A = sparse(matrix(objective ? soft : 0, n, number(0, soft)));
    p.b = matrix(Index(p.A.rows()), channels, n);
    p.weights = matrix(Index(p.A.rows()), 1, n).cwiseAbs();
    if (objective && generator_() % 2) {
      const MatrixXd root = matrix(n / 3, n, n);
      p.H = sparse(root.transpose() * root);
    }
    p.C = sparse(matrix(hard, n, generator_() % 2 ? hard : hard / 2));
    p.d = p.C * matrix(n, channels, n);
    if (generator_() % 3 == 0 && hard > 0) p.d(0, 0) += 1;  // which the others may contradict
    return p;
  }

 private:
  Index number(Index from, Index to) { return from + Index(generator_() % unsigned(to - from + 1)); }
  std::mt19937 generator_{7};
};

struct Reference {
  MatrixXd x;
  bool met;          ///< C x = d
  double narrowest;  ///< least eigenvalue of the objective that is not zero, relative
};

/// Null-space method: least squares for C, then the objective on what C leaves free, both by pseudoinverses.
Reference null_space_method(const FitProblem& p) {
  const MatrixXd A = p.A, C = p.C;
  const Index n = Index(p.x0.rows());
  MatrixXd Q = MatrixXd::Zero(n, n), force = MatrixXd::Zero(n, p.x0.cols()), N = MatrixXd::Identity(n, n);
  if (A.rows() > 0) {
    const Eigen::VectorXd w = p.weights.size() > 0 ? p.weights : Eigen::VectorXd::Ones(A.rows());
    Q += A.transpose() * w.asDiagonal() * A;
    force += A.transpose() * w.asDiagonal() * (p.b - A * p.x0);
  }
  if (p.H.rows() > 0) {
    Q += MatrixXd(p.H);
    force -= p.H * p.x0;
  }
  MatrixXd y = MatrixXd::Zero(n, p.x0.cols());
  if (C.rows() > 0) {
    Eigen::JacobiSVD<MatrixXd> svd(C, Eigen::ComputeFullU | Eigen::ComputeFullV);
    svd.setThreshold(1e-10);
    y = svd.solve(MatrixXd(p.d - C * p.x0));
    N = svd.matrixV().rightCols(n - svd.rank());
  }
  Reference result{p.x0 + y, C.rows() == 0 || difference(C * (p.x0 + y), p.d) < 1e-9, 1};
  if (N.cols() == 0) return result;
  const SymmetricEigenvectors eigen = symmetric_eigenvectors(N.transpose() * Q * N);
  Eigen::VectorXd inverse = eigen.values;
  for (double& l : inverse) {
    const bool seen = l > 1e-10 * Q.norm();
    if (seen) result.narrowest = std::min(result.narrowest, l / Q.norm());
    l = seen ? 1 / l : 0;
  }
  result.x +=
      N * (eigen.vectors * inverse.asDiagonal() * (eigen.vectors.transpose() * (N.transpose() * (force - Q * y))));
  return result;
}

TEST(FitProblem, AgreesWithADenseNullSpaceMethod) {
  RandomProblems problems;
  int contradicting = 0, compared = 0;
  for (int i = 0; i < 300; ++i) {
    const FitProblem p = problems.next();
    const Reference reference = null_space_method(p);
    const FitSolution solution = solve(p, {.method = FitMethod::direct});
    ASSERT_EQ(solution.converged, reference.met) << i;
    contradicting += !reference.met;
    if (reference.narrowest < 1e-4) continue;
    ++compared;
    ASSERT_LE(difference(solution.x, reference.x), random_problem * (1 + reference.x.cwiseAbs().maxCoeff())) << i;
  }
  EXPECT_GT(contradicting, 20);
  EXPECT_GT(compared, 250);
}

TEST(FitProblem, TheNearestOfAllThatMeetConditionsIsFoundByEveryMethod) {
  RandomProblems problems;
  for (const auto& [rows, rank] : {std::pair(5, 5), {9, 4}, {12, 12}, {12, 7}, {20, 12}, {20, 6}})
    for (const bool agreeing : {true, false}) {
      FitProblem p;
      const MatrixXd C = problems.matrix(rows, 12, rank);
      p.C = sparse(C);
      p.x0 = problems.matrix(12, 3, 12);
      p.d = agreeing ? MatrixXd(C * problems.matrix(12, 3, 12)) : problems.matrix(rows, 3, rows);
      const Reference reference = null_space_method(p);
      for (const FitMethod method : {FitMethod::direct, FitMethod::iterative}) {
        const FitSolution solution = solve(p, {.method = method});
        EXPECT_LE(difference(solution.x, reference.x), random_problem) << rows << " " << rank;
        EXPECT_EQ(solution.converged, reference.met) << rows << " " << rank << " " << int(method);
        EXPECT_EQ(solution.method, method);
        EXPECT_EQ(solution.hard_residual, difference(p.C * solution.x, p.d));
      }
    }
}

TEST(FitProblem, LimitPointsOfATorusAreMetToRounding) {
  const Mesh mesh = testing::jittered(testing::torus(31, 40));
  FitProblem p;
  p.C = limit_system("catmull-clark", mesh);
  p.x0 = p.d = mesh.positions;
  const FitSolution direct = solve(p), iterative = solve(p, {.method = FitMethod::iterative});
  EXPECT_EQ(direct.method, FitMethod::direct);  // few unknowns
  for (const FitSolution& solution : {direct, iterative}) {
    EXPECT_TRUE(solution.converged);
    EXPECT_LE(solution.hard_residual, testing::rounding(9, 4));
    EXPECT_EQ(int(solution.history.size()), solution.iterations);
  }
  EXPECT_LE(difference(direct.x, iterative.x), testing::rounding(9, 9 * 4));  // 9: the condition
}

TEST(FitProblem, ConditionsOfTenThousandAreMetToRounding) {
  std::mt19937 generator(3);
  std::normal_distribution<double> normal;
  for (const Index rows : {20, 30, 45}) {
    MatrixXd left(rows, rows), right(30, 30), d(30, 2);
    for (MatrixXd* m : {&left, &right, &d})
      for (double& x : m->reshaped()) x = normal(generator);
    const MatrixXd U = orthonormal_columns(left), V = orthonormal_columns(right);
    const Index rank = std::min<Index>(rows, 30);
    const Eigen::VectorXd s =
        Eigen::VectorXd::LinSpaced(rank, 0, -4).unaryExpr([](double e) { return std::pow(10, e); });
    FitProblem p;
    p.C = sparse(U.leftCols(rank) * s.asDiagonal() * V.leftCols(rank).transpose());
    p.x0 = Points::Zero(30, 2);
    p.d = p.C * d;
    const FitSolution solution = solve(p);
    EXPECT_TRUE(solution.converged) << rows;
    constexpr double residual_of_rounding = 1e-13;
    EXPECT_LE(solution.hard_residual, residual_of_rounding) << rows;
  }
}

TEST(FitProblem, ACubeIsSolvedWhereItsDataAgree) {
  const Mesh cube = testing::cube();
  FitProblem p;
  p.C = limit_system("catmull-clark", cube);
  p.x0 = cube.positions;
  p.d = p.C * (2 * p.x0 + Points::Constant(8, 3, 0.5));
  FitSolution solution = solve(p);
  EXPECT_TRUE(solution.converged);
  EXPECT_LE(difference(solution.x, 2 * p.x0 + Points::Constant(8, 3, 0.5)), testing::rounding(100));
  // Signs that alternate are what no control points can have as limits: half of them stays.
  for (Index i = 0; i < 8; ++i) p.d(i, 0) += (cube.positions.row(i).prod() > 0 ? 1 : -1);
  solution = solve(p);
  EXPECT_FALSE(solution.converged);
  EXPECT_LE(difference(solution.x, 2 * p.x0 + Points::Constant(8, 3, 0.5)), testing::rounding(1000));
  EXPECT_NEAR(solution.hard_residual, 1, testing::rounding(1000));
}

TEST(FitProblem, PinsHoldAndTheRestIsLeastSquares) {
  const Mesh mesh = testing::torus(12, 10);
  FitProblem p;
  p.A = limit_system("catmull-clark", mesh);
  p.b = p.x0 = mesh.positions;
  p.C = sparse(MatrixXd::Identity(120, 120).topRows(7) * 2);
  p.d = Points::Constant(7, 3, 1.5);
  const Reference reference = null_space_method(p);
  for (const FitMethod method : {FitMethod::direct, FitMethod::iterative}) {
    const FitSolution solution = solve(p, {.method = method});
    EXPECT_TRUE(solution.converged);
    EXPECT_EQ(solution.method, method);
    EXPECT_LE(difference(solution.x, reference.x), random_problem);
    EXPECT_LE(difference(solution.x.topRows(7), Points::Constant(7, 3, 0.75)), testing::rounding(4));
    const double mean = (p.A * solution.x - p.b).squaredNorm() / 120;
    EXPECT_NEAR(solution.soft_residual, std::sqrt(mean), testing::rounding(400));
  }
}

TEST(FitProblem, AbsentMatricesNeedNoShape) {
  const Mesh mesh = testing::torus(6, 5);
  FitProblem p;
  p.A = limit_system("catmull-clark", mesh);
  p.b = p.A * mesh.positions;
  p.x0 = Points::Zero(30, 3);
  for (const FitMethod method : {FitMethod::automatic, FitMethod::iterative}) {
    const FitSolution solution = solve(p, {.method = method});
    EXPECT_TRUE(solution.converged);
    EXPECT_LE(difference(solution.x, mesh.positions), random_problem);
  }
}

TEST(FitProblem, TheSameBitsOnAnyNumberOfThreads) {
  const Mesh mesh = testing::jittered(testing::torus(91, 90));
  FitProblem p;
  p.C = limit_system("catmull-clark", mesh);
  p.x0 = p.d = mesh.positions;
  for (const FitMethod method : {FitMethod::direct, FitMethod::iterative}) {
    const Points many = solve(p, {.method = method}).x;
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    EXPECT_EQ(many, solve(p, {.method = method}).x);
  }
}

TEST(FitProblem, ManyUnknownsAreIteratedWhileThatConverges) {
  const Mesh mesh = testing::jittered(testing::torus(101, 100));
  FitProblem p;
  p.C = limit_system("catmull-clark", mesh);
  p.x0 = p.d = mesh.positions;
  int told = 0;
  const FitSolution solution = solve(p, {.progress = [&](int iterations, double residual) {
                                       ++told;
                                       EXPECT_GT(iterations, 0);
                                       EXPECT_GE(residual, 0);
                                     }});
  EXPECT_EQ(solution.method, FitMethod::iterative);
  EXPECT_TRUE(solution.converged);
  EXPECT_GT(told, 3);
  EXPECT_EQ(solve(p, {.max_iterations = 5}).method, FitMethod::direct);  // five steps are not enough
}

TEST(FitProblem, WithoutAnythingToDoNothingMoves) {
  FitProblem p;
  p.x0 = Points::Constant(4, 2, 3);
  p.b = p.d = Points(0, 2);
  EXPECT_EQ(solve(p).x, p.x0);
  EXPECT_TRUE(solve(p).converged);
  p.C = SparseMatrix(2, 4);  // rows without entries
  p.d = Points::Zero(2, 2);
  EXPECT_EQ(solve(p).x, p.x0);
  EXPECT_TRUE(solve(p).converged);
  p.d(1, 1) = 1;
  for (const FitMethod method : {FitMethod::direct, FitMethod::iterative}) {
    EXPECT_EQ(solve(p, {.method = method}).x, p.x0);
    EXPECT_FALSE(solve(p, {.method = method}).converged);
  }
  p = {};
  EXPECT_EQ(solve(p).x.size(), 0);
}

TEST(FitProblem, WhatDoesNotFitIsRefused) {
  const auto good = [] {
    FitProblem p;
    p.x0 = Points::Zero(3, 2);
    p.A = p.C = sparse(MatrixXd::Identity(3, 3));
    p.H = p.A;
    p.b = p.d = Points::Zero(3, 2);
    p.weights = Eigen::VectorXd::Ones(3);
    return p;
  };
  EXPECT_NO_THROW(solve(good()));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<std::function<void(FitProblem&)>> faults = {
      [](FitProblem& p) { p.A = sparse(MatrixXd::Identity(3, 2)); },
      [](FitProblem& p) { p.C = sparse(MatrixXd::Identity(3, 4)); },
      [](FitProblem& p) { p.H = sparse(MatrixXd::Identity(2, 2)); },
      [](FitProblem& p) { p.H = sparse(MatrixXd::Identity(2, 3)); },
      [](FitProblem& p) { p.b = Points::Zero(2, 2); },
      [](FitProblem& p) { p.d = Points::Zero(3, 1); },
      [](FitProblem& p) { p.weights = Eigen::VectorXd::Ones(2); },
      [](FitProblem& p) { p.weights[1] = -1; },
      [&](FitProblem& p) { p.weights[1] = nan; },
      [&](FitProblem& p) { p.x0(0, 0) = nan; },
      [&](FitProblem& p) { p.b(0, 0) = nan; },
      [](FitProblem& p) { p.d(0, 0) = std::numeric_limits<double>::infinity(); },
      [&](FitProblem& p) { p.A.coeffRef(1, 1) = nan; },
      [&](FitProblem& p) { p.C.coeffRef(1, 1) = nan; },
      [&](FitProblem& p) { p.H.coeffRef(1, 1) = nan; },
  };
  for (size_t i = 0; i < faults.size(); ++i) {
    FitProblem p = good();
    faults[i](p);
    EXPECT_THROW(solve(p), InvalidParameter) << i;
  }
}

}  // namespace
}  // namespace sublimit
