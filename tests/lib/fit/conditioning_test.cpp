// SPDX-License-Identifier: Apache-2.0
#include "sublimit/fit/conditioning.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <vector>

#include "meshes/meshes.h"
#include "sublimit/base/error.h"
#include "sublimit/core/detail/dense_decompositions.h"
#include "support/tolerance.h"
#include "truth/limit_system.h"

namespace sublimit {
namespace {

/// Of values that texts print with four.
constexpr double four_digits = 5e-5;

using testing::limit_system;

// Squares of matrices whose inverses are iterated with, of condition 10 to 100.
constexpr double iterated = 1e-12;
// What the iteration stops at, relative, where values lie close together.
constexpr double unsettled = 1e-9;

SparseMatrix diagonal(Index rows, Index columns, const std::vector<double>& values) {
  SparseMatrix D(rows, columns);
  for (size_t i = 0; i < values.size(); ++i) D.insert(Index(i), Index(i)) = values[i];
  D.makeCompressed();
  return D;
}

TEST(Conditioning, LimitPointsOfACubeLeaveAlternatingSignsFree) {
  const SparseMatrix L = limit_system("catmull-clark", testing::cube());
  std::vector<double> eigenvalues;
  const Eigen::VectorXcd spectrum = sublimit::eigenvalues(Eigen::MatrixXd(L));
  for (const std::complex<double>& l : spectrum) {
    EXPECT_NEAR(l.imag(), 0, testing::eigen(10));
    eigenvalues.push_back(l.real());
  }
  std::sort(eigenvalues.begin(), eigenvalues.end());
  const double expected[] = {0, 1. / 6, 1. / 6, 1. / 6, 1. / 2, 1. / 2, 1. / 2, 1};
  for (int i = 0; i < 8; ++i) EXPECT_NEAR(eigenvalues[i], expected[i], testing::eigen());
  const Conditioning c = conditioning(L);
  EXPECT_EQ(c.rank, 7);
  EXPECT_NEAR(c.largest, 1, testing::rounding(8));
  EXPECT_NEAR(c.smallest, 1. / 6, testing::rounding(8));  // L is symmetric
  EXPECT_NEAR(c.condition(), 6, testing::rounding(100));
  ASSERT_EQ(c.free.cols(), 1);
  ASSERT_EQ(c.dependent.cols(), 1);
  const Points corners = testing::cube().positions;
  for (const Points* v : {&c.free, &c.dependent})
    for (Index i = 0; i < 8; ++i)
      EXPECT_NEAR((*v)(i, 0) * corners.row(i).prod(), (*v)(0, 0) * corners.row(0).prod(), testing::rounding(8));
}

TEST(Conditioning, SmallestSingularValuesOfRegularMeshes) {
  EXPECT_NEAR(conditioning(limit_system("loop", testing::tetrahedron())).smallest, 0.2, testing::rounding(8));
  EXPECT_NEAR(conditioning(limit_system("loop", testing::octahedron())).smallest, 0.1545, four_digits);
  EXPECT_NEAR(conditioning(limit_system("loop", testing::icosahedron())).smallest, 0.2350, four_digits);
  // (2/3 + cos(a)/3) (2/3 + cos(b)/3), least where both cosines are -1.
  EXPECT_NEAR(conditioning(limit_system("catmull-clark", testing::torus(8, 6))).smallest, 1. / 9,
              testing::rounding(50));
  const Conditioning odd = conditioning(limit_system("catmull-clark", testing::torus(8, 5)));
  EXPECT_NEAR(odd.smallest, (2 + std::cos(4 * std::acos(-1) / 5)) / 9, testing::rounding(50));
}

TEST(Conditioning, LargeMatricesByIteration) {
  for (const auto& [m, n] : {std::pair(30, 32), {29, 31}}) {
    const Conditioning c = conditioning(limit_system("catmull-clark", testing::torus(m, n)));
    EXPECT_EQ(c.rank, m * n);
    EXPECT_NEAR(c.largest, 1, iterated);
    const auto least = [](Index k) { return (2 + std::cos(2 * std::acos(-1) * (k / 2) / k)) / 3; };
    EXPECT_NEAR(c.smallest, least(m) * least(n), iterated);
    EXPECT_EQ(c.free.size(), 0);
    EXPECT_LT(c.singular_values.size(), 100);
  }
}

TEST(Conditioning, ZerosOfLargeMatricesAreZero) {
  // Two cubes, and a torus that couples with neither: two alternating directions.
  Mesh mesh = testing::disjoint_union(testing::cube(), testing::jittered(testing::torus(30, 26)));
  mesh = testing::disjoint_union(mesh, testing::cube());
  const SparseMatrix L = limit_system("catmull-clark", mesh);
  const Conditioning c = conditioning(L);
  EXPECT_EQ(c.rank, L.rows() - 2);
  EXPECT_LE(c.singular_values[1], testing::rounding(8));
  EXPECT_NEAR(c.smallest, 1. / 9, iterated);
  ASSERT_EQ(c.free.cols(), 2);
  ASSERT_EQ(c.dependent.cols(), 2);
  EXPECT_LE((L * c.free).norm(), testing::rounding(8));
  EXPECT_LE((L.transpose() * c.dependent).norm(), testing::rounding(8));
  EXPECT_LE((c.free.transpose() * c.free - Eigen::MatrixXd::Identity(2, 2)).norm(), testing::rounding(800));
  EXPECT_LE(c.free.middleRows(8, 780).norm(), testing::rounding(800));
}

TEST(Conditioning, AsManyDirectionsVanishAsThereAre) {
  std::vector<double> values(900, 1.0);
  for (size_t i = 0; i < values.size(); ++i) values[i] = i % 30 == 7 ? 0 : i == 1 ? 1 : 1.5 + double(i) / 900;
  for (const auto& [rows, columns] : {std::pair(900, 900), {1000, 900}, {900, 1000}}) {
    const Conditioning c = conditioning(diagonal(rows, columns, values));
    EXPECT_EQ(c.rank, 870);
    EXPECT_NEAR(c.smallest, 1, unsettled);
    EXPECT_EQ(c.free.cols(), rows >= columns ? 30 : 0);
    EXPECT_EQ(c.dependent.cols(), rows <= columns ? 30 : 0);
    EXPECT_EQ(conditioning(diagonal(rows, columns, values), 1e-10, 5).rank, 895 - 1);  // no more than 6 looked for
  }
}

TEST(Conditioning, ShapesOfAllKinds) {
  const Conditioning wide = conditioning(diagonal(2, 5, {3, 2}));
  EXPECT_EQ(wide.rank, 2);
  EXPECT_EQ(wide.free.cols(), 3);
  EXPECT_EQ(wide.dependent.cols(), 0);
  EXPECT_NEAR(wide.smallest, 2, testing::rounding(8));
  const Conditioning tall = conditioning(diagonal(5, 2, {3, 0}));
  EXPECT_EQ(tall.rank, 1);
  EXPECT_EQ(tall.free.cols(), 1);
  EXPECT_EQ(tall.dependent.cols(), 4);
  for (const Index n : {4, 700}) {
    const Conditioning zero = conditioning(SparseMatrix(n, n));
    EXPECT_EQ(zero.rank, 0);
    EXPECT_EQ(zero.condition(), 0);
    EXPECT_EQ(zero.free.cols(), std::min<Index>(n, 64));
  }
  EXPECT_EQ(conditioning(SparseMatrix(0, 3)).free.cols(), 3);
  EXPECT_EQ(conditioning(SparseMatrix(3, 0)).dependent.cols(), 3);
  EXPECT_THROW(conditioning(diagonal(2, 2, {1, std::numeric_limits<double>::quiet_NaN()})), InvalidParameter);
  EXPECT_THROW(conditioning(diagonal(2, 2, {1, 1}), -1), InvalidParameter);
}

}  // namespace
}  // namespace sublimit
