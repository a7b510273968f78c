// SPDX-License-Identifier: Apache-2.0
#include "sublimit/fit/detail/sparse_factors.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <random>

#include "meshes/meshes.h"
#include "support/tolerance.h"
#include "truth/limit_system.h"

namespace sublimit {
namespace {

TEST(SparseFactors, SolvesWhatADenseFactorSolves) {
  std::mt19937 generator(5);
  for (const Index n : {1, 2, 17, 90, 300}) {
    Eigen::MatrixXd B = Eigen::MatrixXd::Zero(n, n), right(n, 4);
    for (Index k = 0; k < 2 * n; ++k) B(generator() % n, generator() % n) = double(generator() % 7) - 3;
    for (double& x : right.reshaped()) x = double(generator() % 9) - 4;
    const Eigen::MatrixXd M = B * B.transpose() + Eigen::MatrixXd::Identity(n, n);
    const SparseFactors factors(SparseMatrix(M.sparseView()));
    ASSERT_TRUE(factors.positive());
    const Points x = factors.solve(right);
    EXPECT_LE((M * x - right).cwiseAbs().maxCoeff(), testing::rounding(n, M.cwiseAbs().maxCoeff() * x.norm())) << n;
  }
}

TEST(SparseFactors, AFullBlockBesideAMesh) {
  const SparseMatrix L = testing::limit_system("catmull-clark", testing::jittered(testing::torus(40, 50)));
  Eigen::MatrixXd M = L * SparseMatrix(L.transpose());
  M.topLeftCorner(500, 500).array() += 0.01;
  const SparseFactors factors(SparseMatrix(M.sparseView()));
  ASSERT_TRUE(factors.positive());
  EXPECT_GT(factors.nonzeros(), 500 * 500 / 2);
  EXPECT_LT(factors.nonzeros(), 2000 * 2000 / 4);
  const Points right = M * Points::Ones(2000, 1);
  EXPECT_LE((factors.solve(right) - Points::Ones(2000, 1)).cwiseAbs().maxCoeff(), testing::eigen(1000));
}

TEST(SparseFactors, PivotsThatAreNotPositiveAreNoticed) {
  Eigen::MatrixXd M = Eigen::MatrixXd::Identity(5, 5);
  M(2, 3) = M(3, 2) = 2;
  EXPECT_FALSE(SparseFactors(SparseMatrix(M.sparseView())).positive());
}

}  // namespace
}  // namespace sublimit
