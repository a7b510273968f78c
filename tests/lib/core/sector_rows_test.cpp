// SPDX-License-Identifier: Apache-2.0
#include "sublimit/core/detail/sector_rows.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <random>

namespace sublimit {
namespace {

using Complex = std::complex<double>;
constexpr double eigenvalue_tolerance = 1e-10;  // of general small matrices

/// A random matrix that commutes with the rotation of orbits.
Eigen::MatrixXd symmetric_matrix(const Orbits& orbits, Eigen::Index slots, int n) {
  std::mt19937 random(3);
  Eigen::VectorXi next(slots);
  for (const auto& orbit : orbits)
    for (size_t s = 0; s < orbit.size(); ++s) next[orbit[s]] = orbit[(s + 1) % orbit.size()];
  Eigen::MatrixXd A = Eigen::MatrixXd::NullaryExpr(slots, slots, [&] { return int(random() % 9) / 8.0 - 0.5; });
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(slots, slots);
  for (int s = 0; s < n; ++s) {
    sum += A;
    A = Eigen::MatrixXd(A(next, next));
  }
  return sum / 8;
}

std::optional<SectorRowsOf<double, Complex>> rows_of(const Eigen::MatrixXd& A, const Orbits& orbits) {
  return sector_rows_of<double, Complex>(
      A.rows(), orbits,
      [&](Index i, const auto& visit) {
        for (Eigen::Index j = 0; j < A.cols(); ++j)
          if (A(i, j) != 0) visit(j, A(i, j));
      },
      [](double a, double b) { return a == b; });
}

struct Case {
  int n;
  Orbits orbits;
};

/// Rotations and a mirror, whose fixed slots need not come first.
const std::vector<Case> cases{{3, {{0}, {1, 3, 5}, {4, 6, 2}}},
                              {4, {{0, 1, 2, 3}, {7, 4, 5, 6}}},
                              {2, {{0, 5}, {1}, {2, 4}, {3}}},
                              {1, {{0}, {1}, {2}}}};

Eigen::Index slots_of(const Orbits& orbits) {
  Eigen::Index slots = 0;
  for (const auto& orbit : orbits) slots += std::ssize(orbit);
  return slots;
}

TEST(SectorRows, BlocksTogetherHaveTheSpectrumOfTheWhole) {
  for (const auto& [n, orbits] : cases) {
    const Eigen::MatrixXd A = symmetric_matrix(orbits, slots_of(orbits), n);
    const auto rows = rows_of(A, orbits);
    ASSERT_TRUE(rows) << n;
    EXPECT_EQ(rows->n, n);
    std::vector<Complex> values;
    for (int k = 0; k < n; ++k) {
      const Eigen::MatrixXcd B = rows->block(k);
      ASSERT_EQ(B.rows(), std::ssize(rows->places(k)));
      const Eigen::VectorXcd own = B.eigenvalues();
      values.insert(values.end(), own.begin(), own.end());
    }
    const Eigen::VectorXcd whole = A.eigenvalues();
    ASSERT_EQ(std::ssize(values), whole.size()) << n;
    for (const Complex value : whole) {
      const auto nearest = std::min_element(values.begin(), values.end(), [&](Complex a, Complex b) {
        return std::abs(a - value) < std::abs(b - value);
      });
      EXPECT_LE(std::abs(*nearest - value), eigenvalue_tolerance) << n;
      values.erase(nearest);
    }
  }
}

TEST(SectorRows, MasksOfLeftEigenvectorsAreLeftEigenvectorsOfTheWhole) {
  for (const auto& [n, orbits] : cases) {
    const Eigen::MatrixXd A = symmetric_matrix(orbits, slots_of(orbits), n);
    const auto rows = rows_of(A, orbits).value();
    for (int k = 0; k < n; ++k) {
      const Eigen::ComplexEigenSolver<Eigen::MatrixXcd> left(rows.block(k).transpose());
      for (Eigen::Index i = 0; i < left.eigenvalues().size(); ++i) {
        const Eigen::VectorXcd mask = rows.mask(k, left.eigenvectors().col(i));
        EXPECT_GT(mask.norm(), eigenvalue_tolerance);
        EXPECT_LE((A.transpose() * mask - left.eigenvalues()[i] * mask).norm(), eigenvalue_tolerance) << n << " " << k;
      }
    }
  }
}

TEST(SectorRows, AnyWeightThatDiffersIsSeen) {
  for (const auto& [n, orbits] : cases) {
    if (n == 1) continue;
    const Eigen::MatrixXd A = symmetric_matrix(orbits, slots_of(orbits), n);
    std::vector<bool> fixed(size_t(A.rows()), false);
    for (const auto& orbit : orbits)
      if (orbit.size() == 1) fixed[size_t(orbit[0])] = true;
    for (Eigen::Index i = 0; i < A.rows(); ++i)
      for (Eigen::Index j = 0; j < A.cols(); ++j)
        for (const double weight : {A(i, j) + 1, 0.0}) {
          Eigen::MatrixXd other = A;
          other(i, j) = weight;
          const bool same = weight == A(i, j) || (fixed[size_t(i)] && fixed[size_t(j)]);
          EXPECT_EQ(rows_of(other, orbits).has_value(), same) << n << ": " << i << ", " << j;
        }
  }
}

TEST(SectorRows, OrbitsThatAreNoneAreRefused) {
  const Eigen::MatrixXd A = Eigen::MatrixXd::Identity(5, 5);
  EXPECT_TRUE(rows_of(A, {{0, 1}, {2, 3}, {4}}));
  EXPECT_FALSE(rows_of(A, {{0, 1}, {2, 3, 4}})) << "two sizes";
  EXPECT_FALSE(rows_of(A, {{0, 1}, {2, 3}})) << "a slot without an orbit";
}

TEST(StrongComponents, AreTheCyclesOfThePattern) {
  // 0 <-> 2 -> 1 -> 3 -> 4 -> 1, and 5 alone.
  using Components = std::vector<std::vector<Index>>;
  Components found = strong_components({{2}, {3}, {0, 1, 1}, {4}, {1}, {}});
  std::sort(found.begin(), found.end());
  EXPECT_EQ(found, (Components{{0, 2}, {1, 3, 4}, {5}}));
}

}  // namespace
}  // namespace sublimit
